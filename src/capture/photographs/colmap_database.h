// What COLMAP's database says about work in progress (https://colmap.github.io/database.html), and in which
// order it numbers pictures.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/result.h"
#include "capture/photographs/picture_pairs.h"

namespace parvis::photographs {

/// How far the work in a database is; all 0 where there is none yet.
struct ColmapProgress {
  std::size_t pictures = 0;  ///< whose features are found
  std::size_t pairs = 0;     ///< of pictures that were compared
};
/// Reads the counts; while COLMAP writes, too.
ColmapProgress colmap_progress(const std::filesystem::path& database);

/// The features of each picture, in the order of COLMAP's numbers; pictures whose features are not found yet,
/// or whose entries are damaged, have none.
std::vector<PictureFeatures> picture_features(const std::filesystem::path& database);

/// The number of features of each picture that agree best, by one geometry, with another picture; 0 where it
/// agrees with none.
std::map<std::string, int> best_agreement(const std::filesystem::path& database);

/// Numbers the pictures, and their features, by the order of their names. COLMAP numbers them as its threads
/// happen to finish them, and what it makes of them depends on the numbers. To be done before features are
/// matched. Errors: the database cannot be written.
Status number_by_name(const std::filesystem::path& database);

}  // namespace parvis::photographs
