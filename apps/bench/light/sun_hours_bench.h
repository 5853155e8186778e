// Hours of sun as a study finds them, against rays at each minute.
#pragma once

#include "bench/benches.h"
#include "scene/data/scene.h"

namespace parvis::bench {

/// The keys sun_hours_error_percent*: the study that `parvis sun` makes of the city about its main crossing,
/// of its ground and its facades. Fails where a study has no points of one of them, or none below trees.
Status measure_sun_hours(const BenchSetup& setup, const scene::Scene& city, Report& report);

}  // namespace parvis::bench
