// Noise: levels against the published cases.
#include "base/test_data.h"
#include "bench/parts.h"
#include "life/propagation/test_noise_cases.h"

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
  report.note(fmt::format("{} of {} figures are the same when rounded; not: {}", air.rounded, air.all,
                          air.differing));
  const propagation::Matches road = propagation::compare_road_checks(*folder, "checks");
  report.add("road_emission_checks", road.agree);
  if (!road.differing.empty()) report.note(road.differing);
}

}  // namespace parvis::bench
