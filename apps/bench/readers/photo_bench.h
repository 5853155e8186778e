// script/bench import_export, the photographs: how fast paths are traced, and how long a photograph of the
// paper's city takes.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Adds path_traced_mrays_s and photo_s_1280x960_64spp. `setup.is_quick`: a photograph of 4 samples per pixel
/// stands for that of 64, whose time is in proportion.
Status measure_photographs(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
