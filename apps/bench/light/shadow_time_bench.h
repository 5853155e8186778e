// What exact shadows cost beside the shadow maps that ship, as the renderer draws both.
#pragma once

#include "bench/report.h"
#include "scene/data/scene.h"

namespace parvis::bench {

/// The keys shadow_rays_over_depth_pass_* and those of the pictures that were timed, in the city's own views
/// with all of its static triangles. Fails if the renderer does, or if a timed picture is wrong.
Status measure_shadow_times(const scene::Scene& city, Report& report);

}  // namespace parvis::bench
