// Shadows of the running renderer against exact rays in double precision.
#pragma once

#include "bench/benches.h"
#include "scene/data/scene.h"

namespace parvis::bench {

/// The keys shadow_*: the renderer with each technique of shadowMap in the streets of `city`.
Status measure_shadows(const BenchSetup& setup, const scene::Scene& city, Report& report);

/// The key shadow_rays_over_depth_pass_time, which `measure_shadows` adds, too. Fails if the renderer does.
Status measure_shadow_times(const scene::Scene& city, Report& report);

}  // namespace parvis::bench
