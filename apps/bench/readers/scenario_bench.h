// script/bench import_export, the scenarios: how long another state of the paper's city keeps the next frame
// waiting.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Adds scenario_switch_ms: choosing a scenario in which four trees of 59,100 triangles have gone and four
/// stand elsewhere, or going back, and the first right frame, less an ordinary frame. Needs a current OpenGL
/// context.
Status measure_scenarios(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
