#include "bench/doors_bench.h"

#include "bench/photo_bench.h"

namespace parvis::bench {

Result<Report> doors_bench(bool is_quick) {
  Report report("doors");
  if (Status status = measure_photographs(is_quick, report); !status) return status.errors();
  return report;
}

}  // namespace parvis::bench
