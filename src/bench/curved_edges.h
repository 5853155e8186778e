// How far straight edges, of which the ends are mirrored, are off from where each point of them is mirrored.
#pragma once

#include "bench/report.h"

namespace parvis::bench {

Status measure_edges(bool is_quick, Report& report);

}  // namespace parvis::bench
