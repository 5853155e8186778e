#include "base/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace parvis {

void run_in_parallel(std::size_t count, std::size_t grain, ParallelRange run, const void* body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const auto& range) { run(body, range.begin(), range.end()); });
}

}  // namespace parvis
