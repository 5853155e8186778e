// A person beside a car's bonnet, in the bench "curved": what virtual objects within a distance add to
// multiple environment maps.
#pragma once

#include "bench/report.h"

namespace parvis::bench {

Status measure_bonnet(bool is_quick, Report& report);

}  // namespace parvis::bench
