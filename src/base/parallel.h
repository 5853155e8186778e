// Parallel loops over indices, on oneTBB.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace parvis {

/// Indices that one task of a parallel loop takes; `body` is the loop's own.
using ParallelRange = void (*)(const void* body, std::size_t begin, std::size_t end);

/// Calls `run(body, begin, end)` for ranges that together are [0, count), on all cores; `grain` indices at
/// least go to one task.
void run_in_parallel(std::size_t count, std::size_t grain, ParallelRange run, const void* body);

/// Calls `body(i)` for every i in [0, count) on all cores; `grain` indices at least go to one task.
template <class Body>
void parallel_for(std::size_t count, Body&& body, std::size_t grain = 1) {
  using Plain = std::remove_reference_t<Body>;
  const ParallelRange run = [](const void* context, std::size_t begin, std::size_t end) {
    Plain& each = *static_cast<Plain*>(const_cast<void*>(context));
    for (std::size_t i = begin; i != end; ++i) each(i);
  };
  run_in_parallel(count, grain, run, std::addressof(body));
}

}  // namespace parvis
