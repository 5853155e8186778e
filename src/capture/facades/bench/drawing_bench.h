// What drawing a captured place takes, beside the same triangles with one texture.
#pragma once

#include "base/result.h"
#include "bench/report.h"

namespace parvis::bench {

/// The keys draw_...: medians of ratios of drawings that follow one another.
Status measure_drawing(bool is_quick, Report& report);

}  // namespace parvis::bench
