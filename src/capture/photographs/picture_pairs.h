// Features that two photographs have in common, and which pairs of photographs are worth comparing: those
// whose largest features already agree (preemptive matching: Wu 2013, "Towards linear-time incremental
// structure from motion"). COLMAP without a GPU takes seconds per pair; here it is a tenth of one.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace parvis::photographs {

inline constexpr std::size_t descriptor_bytes = 128;

/// The features of a picture, the largest first: seen from nearer or farther, they are still among them.
struct PictureFeatures {
  std::string name;                       ///< of the picture
  std::vector<std::uint32_t> numbers;     ///< per feature: its number in COLMAP's lists
  std::vector<glm::vec2> pixels;          ///< by a feature's number: where it is, from the top left corner
  std::vector<std::uint8_t> descriptors;  ///< SIFT as COLMAP keeps it: descriptor_bytes for each feature
};

/// The numbers of a feature in two pictures.
using FeatureMatch = std::pair<std::uint32_t, std::uint32_t>;
/// Two pictures, by their places in a list; the first is the lesser.
using PicturePair = std::pair<std::size_t, std::size_t>;

/// The features of two pictures that are each other's nearest and nearer by far than the next one, of the
/// `largest` of each. COLMAP's own conditions.
std::vector<FeatureMatch> matching_features(const PictureFeatures& a, const PictureFeatures& b,
                                            std::size_t largest = std::numeric_limits<std::size_t>::max());

/// The pairs whose largest features agree, and each picture with those that it shares most with, however few.
/// Ascending.
std::vector<PicturePair> promising_pairs(const std::vector<PictureFeatures>& pictures);

}  // namespace parvis::photographs
