#include "reflections/virtual_objects/bench/curved_reflectors_bench.h"

#include "bench/benches.h"
#include "reflections/virtual_objects/bench/bonnet.h"
#include "reflections/virtual_objects/bench/cost.h"
#include "reflections/virtual_objects/bench/edges.h"
#include "reflections/virtual_objects/bench/explosion.h"
#include "reflections/virtual_objects/bench/grids.h"
#include "reflections/virtual_objects/bench/kitchen.h"
#include "reflections/virtual_objects/bench/refraction.h"
#include "reflections/virtual_objects/bench/roots.h"
#include "reflections/virtual_objects/bench/search.h"
#include "reflections/virtual_objects/bench/two_bounces.h"

namespace parvis::bench {
namespace {

Status measure(const BenchSetup& setup, Report& report) {
  struct Part {
    const char* name;
    Status (*measure)(const BenchSetup&, Report&);
  };
  for (const Part& part : {Part{"explosion maps", measure_explosion_maps},
                           {"search", measure_search},
                           {"roots", measure_roots},
                           {"edges", measure_edges},
                           {"cost", measure_cost},
                           {"grids", measure_grids},
                           {"kitchen", measure_kitchen},
                           {"bonnet", measure_bonnet},
                           {"two bounces", measure_two_bounces},
                           {"refraction", measure_refraction}}) {
    Status status = Done{};
    const double ms = milliseconds([&] { status = part.measure(setup, report); });
    if (!status) return status.errors();
    report.note(fmt::format("{} took {:.0f} s", part.name, 1e-3 * ms));
  }
  return Done{};
}

}  // namespace

void furnish_curved_reflectors(House& house) {
  house.get<Benches>().add(
      {"curved_reflectors", "reflections on curved objects against rays on the fine mesh", measure});
}

}  // namespace parvis::bench
