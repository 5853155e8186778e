// The paper's frame rates reproduced, in the bench "curved": what a frame of the kitchen takes with every
// vertex searched for, with its grids, and with re-rendered cube maps.
#pragma once

#include "bench/report.h"
#include "house/stage/stage.h"

namespace parvis::bench {

/// Of the kitchen's stage. Told in rows: the paper's were those of its machine.
Status measure_frames(house::Stage& stage, Report& report);

}  // namespace parvis::bench
