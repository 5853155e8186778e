// What reflections cost where they are looked at: near the eye, in the street.
#pragma once

#include "bench/report.h"
#include "house/stage/stage.h"
#include "reflections/environment_rays/bench/near_views.h"
#include "reflections/methods/settings.h"

namespace parvis::bench {

/// Milliseconds of each near view, and what the pictures are that they buy.
struct NearCosts {
  std::vector<double> mem_ms, traced_ms, rerendered_ms, face_ms, seen;
  std::vector<double> mem_flip_over_none;  ///< flip_over_none, about the near car
};

/// Times `shipped`, traced and re-rendered reflections at 1280 x 720 in as many near views, each `repeats`
/// times.
Result<NearCosts> near_costs(house::Stage& stage, const methods::Settings& shipped, const NearViewWish& wish,
                             int views, int repeats);

/// `near_cost_ratio_rerendered_over_mem`, in street-level views of a near car in which ten of the city's
/// thirty are seen, with a control.
Status measure_near_costs(house::Stage& stage, const methods::Settings& shipped, bool is_quick,
                          Report& report);

}  // namespace parvis::bench
