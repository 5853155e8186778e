// When a tram is where: one run over a line, computed before anything moves, so that any second can be
// shown without the seconds before it.
//
// Speed: constant acceleration and braking between stops, at most the line's speed, at most what the lateral
// acceleration allows in curves (for the whole length of the tram).
#pragma once

#include <vector>

#include "scene/data/path.h"

namespace parvis::tram {

inline constexpr float acceleration_m_s2 = 1.0f, braking_m_s2 = 1.0f;
inline constexpr float lateral_m_s2 = 0.65f;  ///< in curves without superelevation
inline constexpr float doors_move_s = 2.5f;   ///< of the dwell, at either end

/// Where a tram stops: its front, metres along the line.
struct Stop {
  float front_m = 0.0f;
  float dwell_s = 20.0f;
  bool is_on_left = false;  ///< side of its platform
};

/// State of a tram at a time of its run.
struct Moment {
  double front_m = 0.0;  ///< along the line
  float speed_m_s = 0.0f;
  int stop = -1;             ///< at which it dwells; -1: none
  float doors = 0.0f;        ///< 0 closed, 1 open
  double leaves_in_s = 0.0;  ///< of a stop
};

/// One run along a line.
class Timetable {
 public:
  /// `first_m` and `last_m`: where the front begins and ends, metres along the line, `first_m` < `last_m`;
  /// stops ascend between them. It begins and ends at rest only where a stop is.
  Timetable(const scene::MeasuredPath& line, float first_m, float last_m, std::vector<Stop> stops,
            float max_speed_m_s, float tram_length_m);

  double duration_s() const { return arrives_s_.back(); }  ///< of the run
  /// The tram's state `time_s` after the run began; before and after it: as at its ends.
  Moment at(double time_s) const;

  /// When the front reaches a place of the line, seconds after the run began.
  double reaches_s(float front_m) const;

  const std::vector<Stop>& stops() const { return stops_; }  ///< in their order
  /// The highest speed at which a front may be at a place of the line, without regard to stops, m/s.
  float speed_limit_m_s(float front_m) const;

 private:
  static constexpr float step_m = 0.5f;  ///< between places whose times are kept

  float first_m_;
  std::vector<Stop> stops_;
  std::vector<float> limit_, speed_;          ///< at each place, m/s
  std::vector<double> arrives_s_, leaves_s_;  ///< at each place; they differ where a stop is
  std::vector<int> stop_at_;                  ///< of each place; -1: none
};

}  // namespace parvis::tram
