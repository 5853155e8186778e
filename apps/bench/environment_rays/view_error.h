// How near the truth reflections are: FLIP inside the reflective pixels of near cars, against the ray tracer.
#pragma once

#include <functional>
#include <vector>

#include "bench/environment_rays/near_views.h"
#include "bench/judged_method.h"
#include "bench/report.h"

namespace parvis::bench {

/// FLIP of every method in a view.
struct ViewFlips {
  bool is_at_crossing;
  std::vector<double> of_method;
  std::vector<double> exactly = {};  ///< against a truth of exact shadows, where one is asked for
};

/// The ground truth of a judgement. Its shadows are the maps of the picture.
struct Truth {
  int samples_per_pixel = 16;
  bool also_has_exact_shadows = false;  ///< the same pictures are judged against exact shadows, too
};

/// Judges methods over the first `views` near views of the stage's traffic, at width x height. `also` is
/// called with each view when it has been judged, for what else is to be measured in it; it may let the
/// traffic drive on.
Result<std::vector<ViewFlips>> flips_of_methods(house::Stage& stage, const std::vector<JudgedMethod>& methods,
                                                std::size_t views, int width, int height,
                                                const NearViewWish& wish = {}, const Truth& truth = {},
                                                const std::function<Status(const NearView&)>& also = {});

/// The mean over views of one method's FLIP.
double mean_flip(const std::vector<ViewFlips>& views, std::size_t method);

/// The largest ratio, over views, of one method's FLIP over another's.
double worst_ratio(const std::vector<ViewFlips>& views, std::size_t method, std::size_t over);

/// A row for each method: its mean, and each view.
void note_flips(const std::vector<JudgedMethod>& methods, const std::vector<ViewFlips>& views,
                Report& report);

}  // namespace parvis::bench
