// Bounced light and lamps: pictures against path-traced photographs, and what they cost.
#pragma once

#include "bench/benches.h"
#include "scene/data/scene.h"

namespace parvis::bench {

/// The keys bounced_light_* and flip_to_photograph_*, of `city`, a scene with dayLight and bouncedLight.
Status measure_bounced_light(const BenchSetup& setup, const scene::Scene& city, Report& report);

}  // namespace parvis::bench
