#include "bench/virtual_objects/compared_searches.h"

#include <limits>

#include "bench/report.h"

namespace parvis::bench {
namespace {

constexpr double judged_share = 0.99;

/// A search that never finds a point meets no target.
double ratio_of(const std::vector<double>& over, const std::vector<double>& under) {
  if (over.empty() || under.empty()) return std::numeric_limits<double>::infinity();
  return percentile(over, judged_share) / percentile(under, judged_share);
}

}  // namespace

void ComparedSearches::add(const SearchFigures& newton, const SearchFigures& midpoint,
                           const SearchFigures& control) {
  for (std::size_t i = 0; i < newton.angles_deg.size(); ++i) {
    const std::optional<double> by_newton = newton.angles_deg[i];
    const std::optional<double> by_midpoint = midpoint.angles_deg[i];
    const std::optional<double> by_control = control.angles_deg[i];
    not_found_by_newton.add(!by_newton);
    not_found_by_midpoint.add(!by_midpoint);
    if (!by_midpoint) continue;
    if (by_newton) newton_deg.push_back(*by_newton), beside_newton_deg.push_back(*by_midpoint);
    if (by_control) control_deg.push_back(*by_control), beside_control_deg.push_back(*by_midpoint);
  }
}

double ComparedSearches::newton_ratio() const { return ratio_of(newton_deg, beside_newton_deg); }

double ComparedSearches::control_ratio() const { return ratio_of(control_deg, beside_control_deg); }

}  // namespace parvis::bench
