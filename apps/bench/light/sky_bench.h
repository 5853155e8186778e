// Sun positions and skies, each against a ground truth.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// The keys sun_max_error_deg* and sky_*. Needs a current OpenGL context.
Status measure_sky(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
