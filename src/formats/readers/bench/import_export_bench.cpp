#include "formats/readers/bench/import_export_bench.h"

#include "bench/benches.h"
#include "formats/readers/bench/attack_bench.h"
#include "formats/readers/bench/isolation_bench.h"
#include "formats/readers/bench/photo_bench.h"
#include "formats/readers/bench/places_bench.h"
#include "formats/readers/bench/reading_bench.h"
#include "formats/readers/bench/safety_bench.h"
#include "formats/readers/bench/scenario_bench.h"
#include "graphics/gl/context.h"

namespace parvis::bench {
namespace {

Status measure(const BenchSetup& setup, Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  report.note("machine: " + gl::driver_name());
  for (const auto& measure : {measure_readers, measure_places, measure_scenarios, measure_photographs,
                              measure_safety, measure_isolation, measure_attacks})
    if (Status status = measure(setup, report); !status) return status.errors();
  return Done{};
}

Status measure_places_alone(const BenchSetup& setup, Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  report.note("machine: " + gl::driver_name());
  return measure_places(setup, report);
}

}  // namespace

void furnish_import_export(House& house) {
  house.get<Benches>().add(
      {"import_export", "scripts, city models, scenarios, path-traced photographs, exported glTF", measure});
  house.get<Benches>().add(
      {"import_export_places", "of `import_export`: from bare files to streets", measure_places_alone});
  house.get<Benches>().add(
      {"import_export_isolation", "of `import_export`: reading in child processes alone", measure_isolation});
}

}  // namespace parvis::bench
