// The default search for reflection points beside the paper's: their angles where both end on the surface,
// and how often either does not.
#pragma once

#include <vector>

#include "bench/virtual_objects/judged_body.h"

namespace parvis::bench {

/// A part of all that were counted.
struct Share {
  int counted = 0, all = 0;

  /// Adds one, which counts or does not.
  void add(bool counts) { counted += counts, ++all; }
  /// 0 of none.
  double percent() const { return all ? 100.0 * counted / all : 0.0; }
};

/// What searches make of the same reflections. All are accepted by one rule, whatever they report of
/// themselves: a search that ends where the fine mesh has no surface has no angle there. It counts in that
/// search's share of points not found, and in no percentile.
struct ComparedSearches {
  std::vector<double> newton_deg, beside_newton_deg;    ///< the default search, and the paper's nine steps
  std::vector<double> control_deg, beside_control_deg;  ///< more of the paper's steps, and nine
  Share not_found_by_newton, not_found_by_midpoint;

  /// Figures of one body.
  void add(const SearchFigures& newton, const SearchFigures& midpoint, const SearchFigures& control);
  /// 99th percentile of the default search's angles over that of the paper's; infinite without any.
  double newton_ratio() const;
  /// The same of more steps.
  double control_ratio() const;
};

}  // namespace parvis::bench
