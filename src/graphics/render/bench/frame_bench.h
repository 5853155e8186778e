// Bench `frame`: what a frame of the paper's city costs without and with re-rendered reflections (table 1 of
// Meyer and Loscos 2003), whether hidden cars are culled, and the error of mirrors against the ray tracer.
#pragma once

#include "base/house.h"

namespace parvis::bench {

/// Registers the bench.
void furnish_frame(House& house);

}  // namespace parvis::bench
