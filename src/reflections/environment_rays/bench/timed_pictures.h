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

/// FLIP of the timed method's picture over that of the one without reflections, both against the one by rays,
/// in the frame of now: 1 where the timed method draws no reflections, either; 0 where it shows what rays do.
/// An error where rays show nothing that the sky alone does not.
Result<double> flip_over_none(house::Stage& stage, const TimedPictures& methods, const Camera& camera,
                              int width, int height, const reference::PixelWindow& window);

/// What flip_over_none is to be where a cost is taken.
inline constexpr Target shows_reflections{0.7, false};

}  // namespace parvis::bench
