// Features of photographs, found by COLMAP.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"

namespace parvis::photographs {

/// What COLMAP is to work on.
struct FeatureJob {
  std::filesystem::path pictures;  ///< folder of the photographs
  std::filesystem::path list;      ///< file with their names, one per line
  std::filesystem::path database;  ///< COLMAP's, which is made or gone on with
  std::string lens;                ///< COLMAP's camera model
  bool one_lens = true;            ///< for all of them
  int max_features = 4000;         ///< per photograph
};

/// Finds the features of `count` photographs with a progress bar; COLMAP's output goes to `log`. Errors:
/// COLMAP missing or failed.
Status find_features(const FeatureJob& job, std::size_t count, const std::filesystem::path& log);

/// Runs one stage of COLMAP with a progress bar that `done` of `total` moves.
Status run_stage(const std::string& what, std::size_t total, const std::function<std::size_t()>& done,
                 const std::vector<std::string>& arguments, const std::filesystem::path& log);

/// Longest side of the pictures that features are found in, pixels; finer ones are reduced.
inline constexpr int max_feature_side_px = 1600;

}  // namespace parvis::photographs
