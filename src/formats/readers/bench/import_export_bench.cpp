#include "formats/readers/bench/import_export_bench.h"

#include "bench/benches.h"
#include "formats/readers/bench/attack_bench.h"
#include "formats/readers/bench/isolation_bench.h"
#include "formats/readers/bench/photo_bench.h"
#include "formats/readers/bench/places_bench.h"
#include "formats/readers/bench/reading_bench.h"
#include "formats/readers/bench/safety_bench.h"
#include "formats/readers/bench/scenario_bench.h"

namespace parvis::bench {
namespace {

Status measure(const BenchSetup& setup, Report& report) {
  for (const auto& measure : {measure_readers, measure_places, measure_scenarios, measure_photographs,
                              measure_safety, measure_isolation, measure_attacks})
    if (Status status = measure(setup, report); !status) return status.errors();
  return Done{};
}

}  // namespace

void furnish_import_export(House& house) {
  house.get<Benches>().add({"import_export",
                            "scripts, city models, scenarios, path-traced photographs, exported glTF",
                            in_context(measure)});
  house.get<Benches>().add(
      {"import_export_places", "of `import_export`: from bare files to streets", in_context(measure_places)});
  house.get<Benches>().add(
      {"import_export_isolation", "of `import_export`: reading in child processes alone", measure_isolation});
}

}  // namespace parvis::bench
