// Bench `frame`: what a frame of the paper's city costs without and with re-rendered reflections (table 1 of
// Meyer and Loscos 2003), whether hidden cars are culled, and the error of mirrors against the ray tracer.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Adds the bench.
void add_frame(Benches& benches);

}  // namespace parvis::bench
