// What mirrors show in mirrors: pictures beside those of re-rendered cube maps, against the ray tracer.
#pragma once

#include "bench/report.h"

namespace parvis::bench {

Status measure_two_bounces(bool is_quick, Report& report);

}  // namespace parvis::bench
