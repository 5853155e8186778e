#include "bench/readers/import_export_bench.h"

#include "bench/benches.h"
#include "bench/readers/isolation_bench.h"
#include "bench/readers/photo_bench.h"
#include "bench/readers/places_bench.h"
#include "bench/readers/reading_bench.h"
#include "bench/readers/scenario_bench.h"

namespace parvis::bench {
namespace {

Status measure(const BenchSetup& setup, Report& report) {
  for (const auto& measure :
       {measure_readers, measure_places, measure_scenarios, measure_photographs, measure_isolation})
    if (Status status = measure(setup, report); !status) return status.errors();
  return Done{};
}

}  // namespace

void add_import_export(Benches& benches) {
  benches.add({"import_export", "scripts, city models, scenarios, path-traced photographs, exported glTF",
               in_context(measure)});
  benches.add(
      {"import_export_places", "of `import_export`: from bare files to streets", in_context(measure_places)});
  benches.add(
      {"import_export_isolation", "of `import_export`: reading in child processes alone", measure_isolation});
}

}  // namespace parvis::bench
