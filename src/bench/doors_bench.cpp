#include "bench/doors_bench.h"

#include "bench/photo_bench.h"
#include "bench/reading_bench.h"
#include "bench/safety_bench.h"
#include "bench/scenario_bench.h"
#include "graphics/gl/context.h"

namespace parvis::bench {

Result<Report> doors_bench(bool is_quick) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  Report report("doors");
  report.note("machine: " + gl::driver_name());
  for (const auto& measure : {measure_readers, measure_scenarios, measure_photographs, measure_safety})
    if (Status status = measure(is_quick, report); !status) return status.errors();
  return report;
}

}  // namespace parvis::bench
