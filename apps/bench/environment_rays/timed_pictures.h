// Costs are worth what the pictures are that they buy: a method that draws nothing costs nothing.
#pragma once

#include "bench/judged_method.h"
#include "bench/report.h"

namespace parvis::bench {

/// Methods of one stage whose pictures are compared.
struct TimedPictures {
  const JudgedMethod& timed;  ///< whose cost is taken
  const JudgedMethod& none;   ///< without reflections
  const JudgedMethod& rays;   ///< mirror rays in every pixel (the method traced)
};

/// Against the picture by rays, FLIP over that of the picture without reflections.
struct FlipOverNone {
  double timed;       ///< of the timed method: 1 where it draws no reflections; 0 where it shows what rays do
  double none_again;  ///< without reflections, drawn once more: the control
};

/// Draws the pictures in the frame of now. An error where rays show nothing that the sky alone does not.
Result<FlipOverNone> flip_over_none(house::Stage& stage, const TimedPictures& methods, const Camera& camera,
                                    int width, int height, const reference::PixelWindow& window);

/// Reports the timed method's as `key`, which is to be less than half of what is wrong without reflections,
/// and the control beside it.
void report_shown(const FlipOverNone& flip, const std::string& key, Report& report);

}  // namespace parvis::bench
