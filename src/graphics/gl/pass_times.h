// How long each pass of a frame takes: on a GPU by time stamps that are read when they have come, frames
// later, so that nothing waits for them; on a software driver by the clock.
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "graphics/gl/objects.h"

namespace parvis::gl {

struct PassTime {
  std::string name;
  double seconds = 0.0;
};

/// A frame is begin_frame, then end_pass after each of its passes. Software drivers put off the work of a
/// pass, and their stamps count a part of it: there each pass of one frame in `timed_every` is waited for.
class PassTimes {
 public:
  static constexpr int timed_every = 16;

  /// Needs a current context; so does the rest.
  void begin_frame();
  /// The commands since the last call here or of begin_frame were the pass `name`.
  void end_pass(std::string name);

  /// Times of the latest frame whose times have come, in their order; empty before there is one.
  const std::vector<PassTime>& latest() const { return latest_; }

 private:
  struct Frame {
    std::vector<Query> stamps;       ///< the first: where the frame begins; more than it needs may be there
    std::vector<std::string> names;  ///< of the passes between them
    bool is_waiting = false;
  };

  void stamp();
  void read(Frame& frame);
  void begin_waiting_frame();

  /// More than a driver keeps in flight.
  std::array<Frame, 5> frames_;
  std::size_t current_ = 0;
  std::vector<PassTime> latest_;

  // Of a software driver.
  std::optional<bool> waits_;  ///< unknown before the first frame
  int frame_ = 0;
  bool is_timed_ = false;  ///< the present frame
  std::chrono::steady_clock::time_point pass_began_;
  std::vector<PassTime> waited_;
};

}  // namespace parvis::gl
