// Films whose frames are divided among processes. Finished frames lie in a folder beside the film until it is
// whole: work that is interrupted, or whose process dies, goes on with what is there.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "base/image.h"
#include "base/result.h"
#include "machines/processes.h"

namespace parvis::stage {

/// Everything that determines a film.
struct FilmJob {
  std::filesystem::path output;  ///< .mp4
  int width = 0, height = 0, frames_per_second = 24, frames = 0;
  std::uint64_t key = 0;  ///< of all that the frames depend on: frames of another key are rendered again
  /// Draws a frame; called in each process with ever later numbers, not all of them.
  std::function<Result<Image8>(int frame)> draw;
  const std::atomic<bool>* is_interrupted = nullptr;  ///< when it turns true, no further frame is begun
};

/// The folder of the finished frames of a film: its name and ".frames"; of a name that is too long for that,
/// the beginning and a hash.
std::filesystem::path frames_folder(const std::filesystem::path& film);

/// Draws the frames that are not there yet; all processes call it. The first one then makes the film, the
/// same as if it had drawn all frames, and removes the frames, and the folder if nothing else is in
/// it. Errors: those of `draw`; the film or its
/// frames cannot be written; it was interrupted (the same call goes on).
Status make_divided_film(const FilmJob& job, const machines::Processes& processes);

}  // namespace parvis::stage
