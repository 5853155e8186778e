// How true reflections are on cars that drive: the eye drives along, so that nothing but what a car mirrors
// changes.
#pragma once

#include <vector>

#include "bench/judged_method.h"

namespace parvis::bench {

/// Means over all drives, of each method.
struct MotionErrors {
  std::vector<double> flip;  ///< in the last frame
  std::vector<double>
      difference;                ///< by how much frames differ otherwise than true ones do, of display white
  double true_difference = 0.0;  ///< by how much true frames differ
  int drives = 0;
};

/// Judges methods inside the reflective pixels of near cars after a second of driving, at thirty frames a
/// second and width x height.
Result<MotionErrors> errors_in_motion(house::Stage& stage, const std::vector<JudgedMethod>& methods,
                                      int drives, int width, int height);

}  // namespace parvis::bench
