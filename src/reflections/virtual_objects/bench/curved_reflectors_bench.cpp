#include "reflections/virtual_objects/bench/curved_reflectors_bench.h"

#include <array>

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

void furnish_curved_reflectors(House& house) {
  std::vector<std::string> names;
  for (const Part& part : all_parts) names.emplace_back(part.name);
  house.get<Benches>().add({"curved_reflectors",
                            "reflections on curved objects against rays on the fine mesh", measure,
                            std::move(names)});
}

}  // namespace parvis::bench
