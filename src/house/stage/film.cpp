#include "house/stage/film.h"

#include <csignal>
#include <utility>

namespace parvis::house {
namespace fs = std::filesystem;
namespace {

/// A word that the shell takes as it stands.
std::string quoted(const std::string& word) {
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace

Result<Film> Film::open(const fs::path& file, int width, int height, int frames_per_second) {
  if (width % 2 != 0 || height % 2 != 0)
    return error("{}: a film of {} x {} pixels; H.264 needs even numbers", file.string(), width, height);
  if (file.extension() != ".mp4") return error("{}: films are written as .mp4", file.string());
  if (std::system("command -v ffmpeg > /dev/null") != 0)
    return error("{}: films are written by the program ffmpeg, which is not installed", file.string());
  std::error_code code;
  if (!file.parent_path().empty()) fs::create_directories(file.parent_path(), code);
  if (code)
    return error("{}: the folder cannot be made ({}); choose one that can be written",
                 file.parent_path().string(), code.message());
  const fs::path temporary = file.parent_path() / (".partial-" + file.filename().string());
  const std::string command = fmt::format(
      "ffmpeg -y -loglevel error -f rawvideo -pixel_format rgb24 -video_size {}x{} -framerate {} -i - "
      "-c:v libx264 -preset medium -crf 18 -pix_fmt yuv420p -movflags +faststart {}",
      width, height, frames_per_second,
      quoted("file:" + temporary.string()));  // a name with a colon is no protocol
  std::signal(SIGPIPE, SIG_IGN);  // an encoder that stops is noticed by a failed write, and does not end us
  std::FILE* pipe = popen(command.c_str(), "w");
  if (!pipe) return error("{}: ffmpeg cannot be started", file.string());
  return Film(file, temporary, pipe, width, height);
}

Film::Film(fs::path file, fs::path temporary, std::FILE* pipe, int width, int height)
    : file_(std::move(file)), temporary_(std::move(temporary)), pipe_(pipe), width_(width), height_(height) {}

Film::Film(Film&& other) noexcept
    : file_(std::move(other.file_)),
      temporary_(std::move(other.temporary_)),
      pipe_(std::exchange(other.pipe_, nullptr)),
      width_(other.width_),
      height_(other.height_),
      bytes_(std::move(other.bytes_)) {}

Film::~Film() {
  if (!pipe_) return;
  pclose(pipe_);
  std::error_code code;
  fs::remove(temporary_, code);
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
  return Done{};
}

Status Film::finish() {
  const int status = pclose(std::exchange(pipe_, nullptr));
  std::error_code code;
  if (status == 0) fs::rename(temporary_, file_, code);
  if (status == 0 && !code) return Done{};
  fs::remove(temporary_, code);
  return error("{}: the film cannot be written", file_.string());
}

}  // namespace parvis::house
