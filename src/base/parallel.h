// Parallel loops over indices, on oneTBB.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace parvis {

/// Calls `body(i)` for every i in [0, count) on all cores; `grain` indices at least go to one task.
template <class Body>
void parallel_for(std::size_t count, Body&& body, std::size_t grain = 1) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
  });
}

}  // namespace parvis
