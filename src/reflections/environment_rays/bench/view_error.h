// How near the truth reflections are: FLIP inside the reflective pixels of near cars, against the ray tracer.
#pragma once

#include <vector>

#include "bench/judged_method.h"
#include "bench/report.h"

namespace parvis::bench {

/// FLIP of every method in a view.
struct ViewFlips {
  bool is_at_crossing;
  std::vector<double> of_method;
};

/// Judges methods over the first `views` near views of the stage's traffic, at width x height.
Result<std::vector<ViewFlips>> flips_of_methods(house::Stage& stage, const std::vector<JudgedMethod>& methods,
                                                std::size_t views, int width, int height);

}  // namespace parvis::bench
