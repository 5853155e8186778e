#include "stage/film.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <utility>

#include "base/checked.h"

namespace parvis::stage {
namespace fs = std::filesystem;
namespace {

/// A word that the shell takes as it stands.
std::string quoted(const std::string& word) {
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// Whether the boxes of an MP4 file (ISO/IEC 14496-12, section 4.2) follow each other up to its end, its
/// index (moov) among them: ffmpeg may say that all is well on a disk that is full.
bool has_end(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::error_code code;
  const std::uint64_t size = fs::file_size(file, code);
  bool has_index = false;
  std::uint64_t at = 0;
  while (in && at + 8 <= size) {
    std::array<unsigned char, 16> head{};
    in.seekg(std::streamoff(at));
    if (!in.read(reinterpret_cast<char*>(head.data()), 8)) return false;
    const auto number = [&](std::size_t first, std::size_t bytes) {
      std::uint64_t value = 0;
      for (std::size_t i = first; i < first + bytes; ++i) value = value << 8 | head[i];
      return value;
    };
    std::uint64_t box = number(0, 4);
    if (box == 1 && in.read(reinterpret_cast<char*>(head.data()) + 8, 8)) box = number(8, 8);
    has_index = has_index || std::equal(head.begin() + 4, head.begin() + 8, "moov");
    if (box < 8 || !bytes_fit(at, box, size)) return false;
    at += box;
  }
  return !code && has_index && at == size;
}

}  // namespace

Result<Film> Film::open(const fs::path& file, int width, int height, int frames_per_second) {
  if (width % 2 != 0 || height % 2 != 0)
    return error("{}: a film of {} x {} pixels; H.264 needs even numbers", file.string(), width, height);
  if (file.extension() != ".mp4") return error("{}: films are written as .mp4", file.string());
  if (std::system("command -v ffmpeg > /dev/null") != 0)
    return error("{}: films are written by the program ffmpeg, which is not installed", file.string());
  Result<PartialFile> partial = PartialFile::create(file);
  if (!partial) return partial.errors();
  // ffmpeg gets the file that is there, not its name: else it would make it once more after a signal has
  // removed it.
  const std::string command = fmt::format(
      "ffmpeg -y -loglevel error -f rawvideo -pixel_format rgb24 -video_size {}x{} -framerate {} -i - "
      "-c:v libx264 -preset medium -crf 18 -pix_fmt yuv420p -movflags +faststart -f mp4 file:/dev/fd/3 3< {}",
      width, height, frames_per_second, quoted(partial->path().string()));
  std::signal(SIGPIPE, SIG_IGN);  // an encoder that stops is noticed by a failed write, and does not end us
  std::FILE* pipe = popen(command.c_str(), "w");
  if (!pipe) return error("{}: ffmpeg cannot be started", file.string());
  return Film(file, *std::move(partial), pipe, width, height);
}

Film::Film(fs::path file, PartialFile partial, std::FILE* pipe, int width, int height)
    : file_(std::move(file)), partial_(std::move(partial)), pipe_(pipe), width_(width), height_(height) {}

Film::Film(Film&& other) noexcept
    : file_(std::move(other.file_)),
      partial_(std::move(other.partial_)),
      pipe_(std::exchange(other.pipe_, nullptr)),
      width_(other.width_),
      height_(other.height_),
      frames_(other.frames_),
      bytes_(std::move(other.bytes_)) {}

Film::~Film() {
  if (pipe_) pclose(pipe_);
}

Status Film::add(const Image8& frame) {
  if (frame.width != width_ || frame.height != height_)
    return error("{}: a frame of {} x {} in a film of {} x {}", file_.string(), frame.width, frame.height,
                 width_, height_);
  const std::size_t pixels = std::size_t(width_) * std::size_t(height_),
                    channels = std::size_t(frame.channels);
  bytes_.resize(3 * pixels);
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c) bytes_[3 * i + c] = frame.pixels[i * channels + c];
  if (std::fwrite(bytes_.data(), 1, bytes_.size(), pipe_) != bytes_.size())
    return error("{}: ffmpeg stopped; is the disk full or the folder not writable?", file_.string());
  ++frames_;
  return Ok{};
}

Status Film::finish(const std::string& wave) {
  const int status = pclose(std::exchange(pipe_, nullptr));
  PartialFile partial = std::move(partial_);  // removed at the end, unless it is kept
  if (frames_ == 0) return error("{}: a film of no frames; give it more --seconds", file_.string());
  if (status != 0 || !has_end(partial.path()))
    return error("{}: the film cannot be written whole; is the disk full?", file_.string());
  if (wave.empty()) return partial.keep();
  Result<PartialFile> with_sound = PartialFile::create(file_);
  if (!with_sound) return with_sound.errors();
  const std::string command = fmt::format(
      "ffmpeg -y -loglevel error -f mp4 -i file:/dev/fd/4 -f wav -i - -map 0:v -map 1:a -c:v copy -c:a aac "
      "-b:a 192k "
      "-movflags +faststart -f mp4 file:/dev/fd/3 3< {} 4< {}",
      quoted(with_sound->path().string()), quoted(partial.path().string()));
  std::FILE* pipe = popen(command.c_str(), "w");
  if (!pipe) return error("{}: ffmpeg cannot be started", file_.string());
  const bool is_given = std::fwrite(wave.data(), 1, wave.size(), pipe) == wave.size();
  if (pclose(pipe) != 0 || !is_given || !has_end(with_sound->path()))
    return error("{}: the film's sound cannot be written; is the disk full?", file_.string());
  return with_sound->keep();
}

}  // namespace parvis::stage
