// Hands a frame's time out among things that can be drawn at several levels of quality, by what each is worth
// on the screen. Rooms say what their levels cost by a declared model; in a window the clock corrects it, in
// pictures and films it stands, so that the same command gives the same picture.
#pragma once

#include <span>
#include <utility>
#include <vector>

namespace parvis::render {

/// Of one thing: its levels are ordered from the cheapest up, and each further millisecond buys less.
struct QualityLevel {
  double cost_ms;  ///< by the declared model
  double worth;    ///< of a thing of importance 1
};

/// Something that wants its share in this frame.
struct QualityWish {
  float importance;  ///< its size on the screen, say
  std::span<const QualityLevel> levels;
  int level = 0;  ///< in: that of the last frame; out: what it gets
};

class QualityBudget {
 public:
  explicit QualityBudget(double budget_ms) : budget_ms_(budget_ms) {}

  /// Chooses a level for each: the cheapest for all, then the steps up that are worth most for their time, as
  /// long as they fit. A step that was taken in the last frame counts a little more, so that nothing blinks.
  void choose(std::span<QualityWish> wishes);

  /// What the levels chosen last took, and all the rest of that frame: what follows is planned by them.
  void frame_took(double chosen_ms, double rest_ms);

  double budget_ms() const { return budget_ms_; }
  /// Of a whole frame, as far as is known.
  double planned_ms() const { return rest_ms_ + scale_ * planned_cost_ms_; }

 private:
  struct Step {
    double worth_a_ms;
    int wish, level;
  };

  double budget_ms_;
  double scale_ = 1.0;    ///< true milliseconds of a declared one
  double rest_ms_ = 0.0;  ///< of a frame without the levels
  double planned_cost_ms_ = 0.0;
  std::vector<Step> steps_;
};

}  // namespace parvis::render
