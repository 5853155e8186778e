// Which photographs of a facade graphics memory holds as one walks: the nearest to the eye, as many as a
// budget has room for, so that a long walk needs no more memory than a short one.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace parvis::facades {

/// The changes by a step of the eye. The photographs that leave are given up before others enter.
struct ResidencyChange {
  std::vector<std::uint32_t> leaving, entering;

  bool empty() const { return leaving.empty() && entering.empty(); }
};

/// Follows the eye. Holds no textures itself: it counts units of memory.
class PhotoResidency {
 public:
  /// `centres`: where photographs were taken, in the facade's frame; `units`: what each needs of `max_units`.
  /// Nothing is resident at first.
  PhotoResidency(std::vector<glm::vec3> centres, std::vector<std::size_t> units, std::size_t max_units);

  /// The photographs that are nearest to any of `eyes` (in the facade's frame) become resident, nearest
  /// first, up to the first that has no room; others stay as long as they are in nobody's way.
  ResidencyChange follow(std::span<const glm::vec3> eyes);
  /// A flag per photograph: 1 where it is resident.
  const std::vector<char>& resident() const { return resident_; }
  /// Units in use, never more than max_units.
  std::size_t used_units() const { return used_; }
  /// True if all photographs are resident.
  bool is_complete() const { return resident_count_ == resident_.size(); }

 private:
  std::vector<glm::vec3> centres_;
  std::vector<std::size_t> units_;
  std::size_t max_units_, used_ = 0, resident_count_ = 0;
  std::vector<char> resident_;
};

}  // namespace parvis::facades
