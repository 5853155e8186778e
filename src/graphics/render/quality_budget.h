// Distributes the time of a frame over things that can be drawn at several levels of quality, by their
// importance in the image. Rooms declare the cost of their levels; in a window, measured frame times correct
// that model; for stills and films the model alone decides, so that the same command gives the same image.
#pragma once

#include <span>
#include <utility>
#include <vector>

namespace parvis::render {

/// One level of quality. The levels of a thing are ordered by cost, with diminishing returns.
struct QualityLevel {
  double cost_ms;  ///< by the declared model
  double worth;    ///< for a thing of importance 1
};

/// A thing that asks for a level in this frame.
struct QualityWish {
  float importance;  ///< weight of `worth`, for example the size in the image
  std::span<const QualityLevel> levels;
  int level = 0;  ///< in: the last frame's level; out: the chosen one
};

/// Chooses levels of quality under a time budget (greedy knapsack over the steps between levels).
class QualityBudget {
 public:
  /// `budget_ms`: time of a whole frame, milliseconds.
  explicit QualityBudget(double budget_ms) : budget_ms_(budget_ms) {}

  /// Chooses a level for each wish: first the cheapest for all, then the upgrades with the highest worth per
  /// millisecond while they fit. Upgrades that were taken in the last frame are favoured, so that levels do
  /// not flicker.
  void choose(std::span<QualityWish> wishes);

  /// Feeds back the measured time of the chosen levels and of the rest of the frame, which corrects the cost
  /// model.
  void frame_took(double chosen_ms, double rest_ms);

  /// Another budget from the next choice on; what is known of costs stays.
  void set_budget(double budget_ms) { budget_ms_ = budget_ms; }
  double budget_ms() const { return budget_ms_; }  ///< as given last
  /// Predicted time of the whole frame after the last choice, milliseconds.
  double planned_ms() const { return rest_ms_ + scale_ * planned_cost_ms_; }

 private:
  struct Step {
    double worth_per_ms;
    int wish, level;
  };

  double budget_ms_;
  double scale_ = 1.0;    ///< measured per declared millisecond
  double rest_ms_ = 0.0;  ///< of a frame without the levels
  double planned_cost_ms_ = 0.0;
  std::vector<Step> steps_;
};

}  // namespace parvis::render
