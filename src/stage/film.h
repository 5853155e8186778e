// Films: frames piped to the program ffmpeg, H.264 that every player opens.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/partial_file.h"
#include "base/result.h"

namespace parvis::stage {

/// Writes one film. It appears under its name when `finish` is called, or not at all.
class Film {
 public:
  /// Fails where ffmpeg is not installed or the folder cannot be written. `width` and `height` are even.
  static Result<Film> open(const std::filesystem::path& file, int width, int height, int frames_per_second);
  Film(Film&& other) noexcept;
  Film& operator=(Film&&) = delete;
  ~Film();

  /// Appends an 8-bit sRGB picture of the film's size with 3 or 4 channels.
  Status add(const Image8& frame);
  /// Ends the film, with the sound of a WAVE file's bytes where they are given. Errors: it has no frame;
  /// ffmpeg failed, or left a file without an end (a full disk).
  Status finish(const std::string& wave = {});

 private:
  Film(std::filesystem::path file, PartialFile partial, std::FILE* pipe, int width, int height);

  std::filesystem::path file_;
  PartialFile partial_;
  std::FILE* pipe_;
  int width_, height_;
  std::size_t frames_ = 0;
  std::vector<std::uint8_t> bytes_;  ///< a frame as RGB bytes
};

}  // namespace parvis::stage
