// How near the truth reflections are: FLIP inside the reflective pixels of near cars, against the ray tracer.
#pragma once

#include <functional>
#include <vector>

#include "bench/judged_method.h"
#include "bench/report.h"
#include "reflections/environment_rays/bench/near_views.h"

namespace parvis::bench {

/// FLIP of every method in a view.
struct ViewFlips {
  bool is_at_crossing;
  std::vector<double> of_method;
};

/// The ground truth of a judgement.
struct Truth {
  int samples_per_pixel = 16;
  bool has_exact_shadows = false;  ///< else the renderer's shadow maps
};

/// Judges methods over the first `views` near views of the stage's traffic, at width x height. `also` is
/// called with each view, for what else is to be measured in it.
Result<std::vector<ViewFlips>> flips_of_methods(house::Stage& stage, const std::vector<JudgedMethod>& methods,
                                                std::size_t views, int width, int height,
                                                const NearViewWish& wish = {}, const Truth& truth = {},
                                                const std::function<Status(const NearView&)>& also = {});

/// The mean over views of one method's FLIP.
double mean_flip(const std::vector<ViewFlips>& views, std::size_t method);

/// A row for each method: its mean, and each view.
void note_flips(const std::vector<JudgedMethod>& methods, const std::vector<ViewFlips>& views,
                Report& report);

}  // namespace parvis::bench
