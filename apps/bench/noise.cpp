// Noise: levels against the published cases; the map of a quarter.
#include "base/test_data.h"
#include "bench/parts.h"
#include "life/propagation/test_noise_cases.h"
#include "planning/noise/noise_map.h"

namespace parvis::bench {
namespace {

/// Cases of which every octave of the long-term level, with and without lateral paths, is within 0.1 dB.
int cases_passed(const std::vector<propagation::CaseResult>& cases) {
  return int(std::ranges::count_if(cases, [](const propagation::CaseResult& it) {
    return std::max(it.total_db, it.without_lateral_db) <= 0.1;
  }));
}

}  // namespace

void measure_noise_cases(const BenchSetup&, Report& report) {
  const auto folder = shared_data("noise", std::filesystem::current_path());
  if (!folder) return report.skip("cnossos_cases_passed", "the shared data is absent");
  const auto cases = propagation::compute_cases(*folder);
  double largest_db = 0.0;
  for (const propagation::CaseResult& it : cases) {
    const double off_db = std::max(it.total_db, it.without_lateral_db);
    largest_db = std::max(largest_db, off_db);
    report.note(
        fmt::format("{}: {:.3f} dB; single paths {:.3f} dB ({})", it.id, off_db, it.path_db, it.worst));
  }
  report.add("cnossos_cases_passed", cases_passed(cases));
  report.add("cnossos_cases_passed_in_warm_air", cases_passed(propagation::compute_cases(*folder, 10.0)));
  report.add("cnossos_largest_difference_db", largest_db);
  const propagation::Matches air = propagation::compare_air_table(*folder);
  report.add("air_absorption_matches", air.agree);
  report.add("air_absorption_matches_in_warm_air", propagation::compare_air_table(*folder, 2.0).agree);
  report.note(fmt::format("{} of {} figures are the same when rounded; not: {}", air.rounded, air.all,
                          air.differing));
  const propagation::Matches road = propagation::compare_road_checks(*folder, "checks");
  report.add("road_emission_checks", road.agree);
  report.add("road_emission_checks_in_warm_air",
             propagation::compare_road_checks(*folder, "checks", 5.0).agree);
  if (!road.differing.empty()) report.note(road.differing);
}

void measure_noise_map(const BenchSetup& setup, Report& report) {
  const auto data = shared_data("cities", std::filesystem::current_path());
  if (!data) return report.skip("noise_resummed_ms", "the shared data is absent");
  const std::filesystem::path folders[]{data->parent_path()};
  const scene::Scene scene = setup.scene(std::filesystem::current_path() / "scenes/denhaag.xp", folders);
  noise::NoiseOptions options;
  options.has_facades = false, options.cell_m = setup.is_quick ? 20.0 : 10.0;
  options.area = glm::dvec4(-50, -220, 210, 0);
  double points_per_s[2]{}, with_rays_ms = 0.0;
  std::optional<noise::NoiseMap> map;
  for (const int reflections : {0, 3}) {
    options.paths.reflections = reflections;
    const double took_ms = milliseconds([&] { map = must(noise::compute_noise(scene, options)); });
    points_per_s[reflections / 3] = 1e3 * double(map->receivers.size()) / took_ms;
    with_rays_ms = took_ms * 1e4 / double(map->receivers.size());
  }
  report.add("noise_map_points_per_s", points_per_s[1]);
  report.add("noise_map_points_per_s_without_reflections", points_per_s[0]);
  // 10,000 receivers: those of the map, over and over.
  noise::KeptTransfers many;
  for (std::size_t i = 0; i < 10'000; ++i) {
    const std::size_t of = i % map->receivers.size();
    for (std::size_t k = map->transfers.first[of]; k < map->transfers.first[of + 1]; ++k)
      many.patches.push_back(map->transfers.patches[k]), many.energies.push_back(map->transfers.energies[k]);
    many.first.push_back(many.patches.size());
  }
  std::vector<double> summed_ms;
  for (int i = 0; i < (setup.is_quick ? 5 : 15); ++i) {
    summed_ms.push_back(
        milliseconds([&] { noise::sum_levels(many, noise::multiplied(map->sources, 1.0 + 0.1 * i)); }));
  }
  report.add("noise_resummed_ms", median(summed_ms));
  report.add("noise_resummed_ms_with_rays", with_rays_ms);
  report.note(fmt::format("{} receivers, {} pieces of road, {} pairs", map->receivers.size(),
                          map->sources.patches.size(), map->transfers.patches.size()));
}

}  // namespace parvis::bench
