// Pictures of a city by night, in the light of its lamps, against photographs.
#pragma once

#include "bench/benches.h"
#include "scene/data/scene.h"

namespace parvis::bench {

/// The keys flip_to_photograph_at_night*, of `city`, a scene with dayLight, lamps and traffic: what of it
/// burns at nightfall - street lamps, windows, shop fronts and headlights - as the renderer that ships draws
/// it and as the path tracer has it.
Status measure_night(const BenchSetup& setup, const scene::Scene& city, Report& report);

}  // namespace parvis::bench
