// What bounced light costs when the hour changes.
#pragma once

#include "bench/report.h"
#include "scene/data/scene.h"

namespace parvis::bench {

/// The keys bounced_light_update*, of `city`, a scene with dayLight whose bouncedLight is on.
Status measure_bounced_update(const scene::Scene& city, Report& report);

}  // namespace parvis::bench
