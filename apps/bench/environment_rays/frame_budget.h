// How well a method that holds a budget holds it: real frames of a drive, by the clock.
#pragma once

#include "bench/report.h"
#include "house/stage/stage.h"
#include "reflections/methods/settings.h"

namespace parvis::bench {

/// `budget_p95_error_percent`: of a drive of so many seconds behind a car, at thirty frames per second and
/// width x height. The budget lies midway between what frames take with the fewest pixels and the cheapest
/// reflections, and with all pixels and the best.
Status measure_budget(house::Stage& stage, const methods::Settings& reflection, int seconds, int width,
                      int height, Report& report);

}  // namespace parvis::bench
