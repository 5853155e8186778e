// How exactly and how fast reflection points are found: Newton's method beside the paper's midpoint method,
// on maps of ellipsoids and of real bodies, and on ellipsoids themselves.
#pragma once

#include "bench/benches.h"
#include "bench/virtual_objects/judged_body.h"

namespace parvis::bench {

/// The paper's search on one map: nine steps of the midpoint method, from where they may begin at little
/// cost. It does not look up once more whether there is surface at its end.
MapSearch::PatchPoint by_midpoint(MapSearch& search, const MapSearch::ReflectionTask& task);

/// Real bodies come from the shared data; where one is absent, the figures of all bodies are skipped.
Status measure_search(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
