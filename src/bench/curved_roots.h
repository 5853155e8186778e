// Do searches find every reflection point of a vertex? On a torus and inside a concave ball, which show it
// several times.
#pragma once

#include "bench/report.h"

namespace parvis::bench {

Status measure_roots(bool is_quick, Report& report);

}  // namespace parvis::bench
