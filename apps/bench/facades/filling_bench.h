// How well filling finds a texture that is hidden in photographs and known.
#pragma once

#include "base/result.h"
#include "bench/report.h"

namespace parvis::bench {

/// The keys fill_...: over all hidden pixels of all photographs of houses of the paper's city.
Status measure_filling(bool is_quick, Report& report);

}  // namespace parvis::bench
