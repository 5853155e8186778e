// Virtual grids, in the bench "curved": their pictures and their flicker beside the search for every vertex.
#pragma once

#include "bench/report.h"

namespace parvis::bench {

Status measure_grids(bool is_quick, Report& report);

}  // namespace parvis::bench
