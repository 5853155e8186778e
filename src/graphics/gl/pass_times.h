// How long the GPU works on each pass of a frame, by time stamps that are read when they have come, frames
// later: nothing waits for them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "graphics/gl/objects.h"

namespace parvis::gl {

struct PassTime {
  std::string name;
  double seconds = 0.0;
};

/// A frame is begin_frame, then end_pass after each of its passes. Software drivers put off
/// the work of a pass: their times mean little.
class PassTimes {
 public:
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

  /// More than a driver keeps in flight.
  std::array<Frame, 5> frames_;
  std::size_t current_ = 0;
  std::vector<PassTime> latest_;
};

}  // namespace parvis::gl
