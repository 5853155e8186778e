#include "bench/virtual_objects/curved_reflectors_bench.h"

#include <array>

#include "bench/benches.h"
#include "bench/virtual_objects/bonnet.h"
#include "bench/virtual_objects/cost.h"
#include "bench/virtual_objects/edges.h"
#include "bench/virtual_objects/explosion.h"
#include "bench/virtual_objects/grids.h"
#include "bench/virtual_objects/kitchen.h"
#include "bench/virtual_objects/refraction.h"
#include "bench/virtual_objects/roots.h"
#include "bench/virtual_objects/search.h"
#include "bench/virtual_objects/two_bounces.h"

namespace parvis::bench {
namespace {

struct Part {
  const char* name;
  Status (*measure)(const BenchSetup&, Report&);
};
constexpr std::array all_parts{Part{"explosion_maps", measure_explosion_maps},
                               Part{"search", measure_search},
                               Part{"roots", measure_roots},
                               Part{"edges", measure_edges},
                               Part{"cost", measure_cost},
                               Part{"grids", measure_grids},
                               Part{"kitchen", measure_kitchen},
                               Part{"bonnet", measure_bonnet},
                               Part{"two_bounces", measure_two_bounces},
                               Part{"refraction", measure_refraction}};

Status measure(const BenchSetup& setup, Report& report) {
  std::vector<BenchPart> parts;
  for (const Part& part : all_parts)
    parts.push_back({part.name, [&setup, &report, part]() -> Status {
                       Status status = Done{};
                       const double ms = milliseconds([&] { status = part.measure(setup, report); });
                       if (status) report.note(fmt::format("{} took {:.0f} s", part.name, 1e-3 * ms));
                       return status;
                     }});
  return run_parts(setup, parts);
}

}  // namespace

void add_curved_reflectors(Benches& benches) {
  std::vector<std::string> names;
  for (const Part& part : all_parts) names.emplace_back(part.name);
  benches.add({"curved_reflectors", "reflections on curved objects against rays on the fine mesh", measure,
               std::move(names)});
}

}  // namespace parvis::bench
