#include "stage/divided_film.h"

#include <optional>

#include "base/files.h"
#include "base/image_io.h"
#include "base/progress.h"
#include "base/sealed_file.h"
#include "machines/divided_work.h"
#include "stage/film.h"
#include "stage/output_names.h"

namespace parvis::stage {
namespace fs = std::filesystem;
namespace {

constexpr SealedKind frame_kind{"PARVISF1", "frame of a film"};

fs::path frame_file(const FilmJob& job, std::uint32_t frame) {
  return frames_folder(job.output) / fmt::format("{:016x}-{:06}.frame", job.key, frame);
}

/// Keeps a finished frame, as it is compressed, with what it is of.
Status keep_frame(const FilmJob& job, std::uint32_t frame, const Image8& picture) {
  const Result<std::string> bytes = encode_image(picture, frame_file(job, frame).string() + ".png");
  if (!bytes) return bytes.errors();
  std::string content;
  append_value(content, job.key);
  append_value(content, frame);
  return write_sealed(frame_file(job, frame), frame_kind, content + *bytes);
}

/// The compressed picture of a finished frame.
Result<std::string> kept_frame(const FilmJob& job, std::uint32_t frame) {
  const fs::path file = frame_file(job, frame);
  const Result<std::string> content = read_sealed(file, frame_kind);
  if (!content) return content.errors();
  ByteReader reader(*content);
  if (reader.take<std::uint64_t>() != job.key || reader.take<std::uint32_t>() != frame)
    return error("{}: is another frame", file.string());
  return std::string(reader.rest());
}

/// The frames that no earlier run has finished.
machines::Tasks unfinished(const FilmJob& job) {
  machines::Tasks frames;
  for (std::uint32_t frame = 0; frame < std::uint32_t(job.frames); ++frame) {
    if (std::error_code ignored; fs::exists(frame_file(job, frame), ignored)) {
      const Result<std::string> kept = kept_frame(job, frame);
      if (kept) continue;
      fmt::print(stderr, "warning: {}; it is rendered again\n", kept.errors().front().message);
    }
    frames.push_back(frame);
  }
  return frames;
}

std::string rgb_of(const Image8& picture) {
  std::string bytes;
  bytes.reserve(picture.pixels.size() / std::size_t(picture.channels) * 3);
  for (std::size_t i = 0; i < picture.pixels.size(); i += std::size_t(picture.channels))
    for (std::size_t c = 0; c < 3; ++c) bytes += char(picture.pixels[i + c]);
  return bytes;
}

Error interrupted(const FilmJob& job) {
  return error("{}: interrupted; its frames so far are kept in {}, and the same command goes on",
               job.output.string(), frames_folder(job.output).string());
}

/// Removes the frames of this and of earlier commands, and the folder where nothing else is in it.
void remove_frames(const FilmJob& job) {
  const std::size_t name_length = frame_file(job, 0).filename().string().size();
  std::error_code code;
  std::vector<fs::path> frames;
  for (const fs::directory_entry& entry : fs::directory_iterator(frames_folder(job.output), code)) {
    const std::string name = entry.path().filename().string();
    if (name.size() == name_length && name.ends_with(".frame") &&
        name.substr(0, 16).find_first_not_of("0123456789abcdef") == std::string::npos && name[16] == '-')
      frames.push_back(entry.path());
  }
  for (const fs::path& frame : frames) fs::remove(frame, code);
  fs::remove(frames_folder(job.output), code);
}

/// Writes the film out of the finished frames.
Status encode(const FilmJob& job, Film& film) {
  Progress progress("writing film", std::size_t(job.frames));
  for (std::uint32_t frame = 0; frame < std::uint32_t(job.frames); ++frame) {
    if (job.is_interrupted && *job.is_interrupted) return interrupted(job);
    const Result<std::string> bytes = kept_frame(job, frame);
    if (!bytes) return bytes.errors();
    const Result<Image8> picture =
        read_image8({reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()},
                    frame_file(job, frame).string());
    if (!picture) return picture.errors();
    if (Status status = film.add(*picture); !status) return status;
    progress.advance();
  }
  return film.finish();
}

}  // namespace

fs::path frames_folder(const fs::path& film) { return file_beside(film, ".frames"); }

Status make_divided_film(const FilmJob& job, const machines::Processes& processes) {
  std::optional<Film> film;
  if (std::error_code code; fs::is_symlink(frames_folder(job.output), code))
    return error("{}: is a link; no frames are kept there. Remove it", frames_folder(job.output).string());
  if (processes.is_first()) {  // before hours of work: can it be written at all?
    Result<Film> opened = Film::open(job.output, job.width, job.height, job.frames_per_second);
    if (!opened) return opened.errors();
    film.emplace(*std::move(opened));
  }
  const machines::Tasks to_do = processes.is_first() ? unfinished(job) : machines::Tasks();
  Progress progress("rendering film", to_do.size());
  machines::DividedWork work;
  work.uses_threads = false;
  work.is_interrupted = job.is_interrupted;
  work.run = [&](std::uint32_t frame) -> Result<std::string> {
    const Result<Image8> picture = job.draw(int(frame));
    if (!picture) return picture.errors();
    return rgb_of(*picture);
  };
  work.keep = [&](std::uint32_t frame, std::string_view bytes) -> Status {
    Image8 picture(job.width, job.height, 3);
    if (bytes.size() != picture.pixels.size())
      return error("frame {} has {} bytes; expected {}", frame, bytes.size(), picture.pixels.size());
    std::copy(bytes.begin(), bytes.end(), picture.pixels.begin());
    progress.advance();
    return keep_frame(job, frame, picture);
  };
  const Result<std::size_t> kept = machines::divide(processes, to_do, work);
  if (!kept) return kept.errors();
  if (!processes.is_first()) return Ok{};
  if (*kept < to_do.size()) return interrupted(job);
  if (Status status = encode(job, *film); !status) return status;
  remove_frames(job);
  return Ok{};
}

}  // namespace parvis::stage
