// What reflections cost: the passes that make them, timed alone, and what the pass of the cars takes longer
// with them than without.
#pragma once

#include <functional>
#include <vector>

#include "bench/judged_method.h"
#include "bench/report.h"
#include "house/stage/stage.h"

namespace parvis::bench {

/// Until OpenGL has done all of the work, and none that came before it.
double finished_ms(const std::function<void()>& work);

/// Milliseconds of one method, one sample a repetition.
struct ReflectionCost {
  std::vector<double> ms;        ///< reflections alone
  std::vector<double> frame_ms;  ///< whole frames, shadows kept; empty: left out
};

/// Whether frames are timed, too.
enum class Frames : bool { left_out, whole };

/// Times methods in alternating order, each `repeats` times (at least 1), one sample of each a turn, after a
/// turn that is not timed; the first must be the method without reflections, whose cost is nothing. Before
/// each turn the scene plays `step_s` on: what methods keep between frames counts as it does in motion. A
/// turn in which a method lacked surroundings (Reflections::supply) is not counted: it is supplied, and the
/// turn is taken again; an error where that does not end.
Result<std::vector<ReflectionCost>> reflection_costs(house::Stage& stage,
                                                     const std::vector<JudgedMethod>& methods,
                                                     const Camera& camera, int width, int height, int repeats,
                                                     Frames frames, double step_s = 0.0);

/// Ratio of two medians; its interval is the widest that both of theirs allow.
Median ratio(const Median& over, const Median& under);

/// The median of the ratios of samples taken in turn: what slows both for a while leaves it as it is.
Median ratio_in_turn(const std::vector<double>& over, const std::vector<double>& under);

}  // namespace parvis::bench
