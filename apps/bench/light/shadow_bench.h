// Shadows of the running renderer against exact rays in double precision.
#pragma once

#include "bench/benches.h"
#include "scene/data/scene.h"

namespace parvis::bench {

/// The keys shadow_*: the renderer with each technique of shadowMap in the streets of `city`, and what exact
/// shadows cost (shadow_time_bench.h).
Status measure_shadows(const BenchSetup& setup, const scene::Scene& city, Report& report);

}  // namespace parvis::bench
