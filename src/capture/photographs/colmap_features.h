// Features of photographs, found by COLMAP.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"

namespace parvis::photographs {

/// Input of COLMAP's work on features.
struct FeatureJob {
  std::filesystem::path pictures;  ///< folder of the photographs
  std::filesystem::path list;      ///< file that names the photographs at work, one per line; is written
  std::filesystem::path database;  ///< COLMAP's, which is made or gone on with
  std::string lens;                ///< COLMAP's camera model
  std::vector<std::vector<std::string>> groups;  ///< names of photographs that share one lens
  std::vector<std::string> alone;                ///< of those that have a lens each
  int max_features = 4000;                       ///< per photograph
};

/// Finds the features of the photographs with a progress bar; COLMAP's output goes to `log`. The photographs
/// are numbered by the order of their names, whichever was finished first. Errors: COLMAP missing or failed.
Status find_features(const FeatureJob& job, const std::filesystem::path& log);

/// Runs one stage of COLMAP with a progress bar that `done` of `total` moves.
Status run_stage(const std::string& what, std::size_t total, const std::function<std::size_t()>& done,
                 const std::vector<std::string>& arguments, const std::filesystem::path& log);

/// Longest side of the pictures that features are found in, pixels; finer ones are reduced.
inline constexpr int max_feature_side_px = 1600;

}  // namespace parvis::photographs
