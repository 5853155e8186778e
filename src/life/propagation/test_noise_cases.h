// The shared cases of outdoor sound (../shared/data/noise), computed: for tests and the bench.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace parvis::propagation {

/// One case of ISO/TR 17534-4 with the largest differences from its printed levels over all octaves.
struct CaseResult {
  std::string id;
  double total_db = 0.0;            ///< A-weighted long-term levels, with lateral paths
  double without_lateral_db = 0.0;  ///< the same without them
  double path_db = 0.0;             ///< levels of single paths in either condition
  std::string worst;                ///< which path, condition and octave differs most
  bool finds_corners = true;        ///< the search for lateral paths finds the corners that the case names
};

/// All cases of iso_tr_17534_4.json. The air is warmer than theirs by `warmer_c`, as a control.
std::vector<CaseResult> compute_cases(const std::filesystem::path& folder, double warmer_c = 0.0);

/// A count of values that agree, and what does not.
struct Matches {
  int agree = 0, all = 0;
  int rounded = 0;  ///< of a printed table: those that are the same when rounded
  std::string differing;
};

/// Printed figures of ISO 9613-2's table 2 (air_absorption.csv), within one unit of the last printed digit.
/// The air is warmer than its by `warmer_c`, as a control.
Matches compare_air_table(const std::filesystem::path& folder, double warmer_c = 0.0);
/// The checks of road_emission_2015_checks.json within its tolerance; `key`: "checks" or "further_checks".
Matches compare_road_checks(const std::filesystem::path& folder, const char* key, double warmer_c = 0.0);
/// Coefficients in use against road_emission_2020.json: each number is one value.
Matches compare_road_coefficients(const std::filesystem::path& folder);

}  // namespace parvis::propagation
