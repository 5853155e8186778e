// How long frames take, for a person who watches: the last frames one by one; passes, and the program's own
// work beside them, smoothed.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "graphics/gl/pass_times.h"

namespace parvis::viewer {

class FrameStatistics {
 public:
  static constexpr std::size_t frames_kept = 120;

  /// A frame took that long; `passes` are what the GPU last told, of this frame or one before.
  void add(double frame_s, std::span<const gl::PassTime> passes);
  /// The times of the program itself in that frame: people and traffic, sound.
  void add_on_processor(std::span<const gl::PassTime> passes);

  /// Milliseconds, the oldest first; fewer than `frames_kept` at first.
  std::vector<float> frames_ms() const;
  double mean_ms() const;
  double worst_ms() const;
  /// Smoothed over some ten frames.
  const std::vector<gl::PassTime>& passes() const { return passes_; }
  const std::vector<gl::PassTime>& passes_on_processor() const { return passes_on_processor_; }

 private:
  std::array<float, frames_kept> frames_ms_{};
  std::size_t count_ = 0;  ///< of all frames
  std::vector<gl::PassTime> passes_, passes_on_processor_;
};

/// The rate of frames that take so long, for people: "24 per second", "2.5 per second", and below one "one in
/// 3.4 s". Empty where nothing was measured.
std::string frame_rate(double frame_ms);

}  // namespace parvis::viewer
