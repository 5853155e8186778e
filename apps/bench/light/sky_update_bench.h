// What it costs to show the sky of another hour.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// The keys sky_update_ms*: from a message to a running scene's dayLight to the sky's textures on the GPU.
/// Needs a current OpenGL context.
Status measure_sky_update(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
