// What a set of reference maps is worth: how many show the paper's city, what they take, what a ray through
// its heights costs.
#pragma once

#include "bench/report.h"
#include "scene/data/scene.h"

namespace parvis::bench {

/// `placement_*`: maps that show 99 % of what vehicles will mirror, and how many fewer these are than an even
/// spread takes: `placement_saving_percent` of the goal that is shipped, which is to show it sharply. Takes
/// about a minute.
void measure_placement(const scene::Scene& scene, Report& report);

/// `maps_mb_54` and the same compressed; needs a current OpenGL context.
void measure_memory(int face_resolution, Report& report);

/// `ray_ns_1m`, `ray_ns_025m`: one ray of a street on one core, by the pyramid.
void measure_rays(const scene::Scene& scene, Report& report);

}  // namespace parvis::bench
