// The time of one thing that runs: a timer, a path, a tour. It starts, halts, goes on, and may start over.
#pragma once

#include <cmath>

namespace parvis::action {

class Clock {
 public:
  /// Starts over after `period_s`; 0: never.
  explicit Clock(double period_s = 0.0) : period_s_(period_s) {}

  double time_s() const { return time_s_; }
  /// The time in `ahead_s` from now, seconds.
  double time_s(double ahead_s) const {
    const double time = time_s_ + ahead_s;
    return period_s_ > 0.0 ? std::fmod(time, period_s_) : time;
  }
  void start() { time_s_ = before_s_ = 0.0; }
  void advance(double seconds) {
    before_s_ = time_s_;
    time_s_ = time_s(seconds);
  }
  /// Did the last `advance` come to `mark_s` (or, the moment after `start`, is it 0)? Marks at the end of a
  /// period are those at its beginning.
  bool passed(double mark_s) const {
    if (time_s_ == before_s_) return mark_s == time_s_;
    if (time_s_ > before_s_) return mark_s > before_s_ && mark_s <= time_s_;
    return mark_s > before_s_ || mark_s <= time_s_;  // it started over
  }

 private:
  double period_s_;
  double time_s_ = 0.0, before_s_ = 0.0;
};

}  // namespace parvis::action
