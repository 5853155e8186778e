// What a scene's own method makes of its mirrors and its glass, beside cube maps that are rendered again
// every frame.
#pragma once

#include <span>

#include "bench/report.h"
#include "house/stage/stage.h"
#include "reflections/methods/settings.h"

namespace parvis::bench {

/// The baseline: the scene's settings, but by cube maps of 512 pixels per face with centres of their own.
methods::Settings rerendered_baseline(const scene::Scene& scene);

/// Adds the figure `key`: FLIP to the ray tracer's pictures inside what mirrors or refracts, by the stage's
/// method over that by the baseline, summed over views from
/// `cameras`. It is to be at most `max_ratio`; the control has no reflections.
Status measure_beside_rerendered(house::Stage& stage, std::span<const char* const> cameras, int width,
                                 int height, const std::string& key, double max_ratio, Report& report);

}  // namespace parvis::bench
