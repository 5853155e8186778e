// Starting points for searches over a reflector map: points spread over its patch, with the surface's
// curvature at each.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "reflections/reflection_search/reflection_search.h"
#include "reflections/reflector_maps/reflector_patches.h"

namespace parvis::reflector_maps {

struct ReflectorMap;

/// Starting points of a map: those of the layers, as many near each of them, and all.
inline constexpr std::size_t layer_start_count = reflection_search::search_start_count,
                             starts_beside = reflection_search::starts_beside,
                             start_count = reflection_search::all_start_count;

/// A surface point and the curvature there, in the tangent plane spanned by `normal` and `u`
/// (patch_search.glsl).
struct MapStart {
  glm::vec3 position, normal, u, curvature;
};

/// All starting points of a map, as a structure of arrays for vectorised evaluation. The first 16 are spread
/// over the patch, the very first near its middle; then eight neighbours of the first, eight of the second,
/// and so on.
class MapStarts {
 public:
  MapStart operator[](std::size_t i) const {
    const auto vector = [&](std::size_t first) {
      return glm::vec3(numbers_[first][i], numbers_[first + 1][i], numbers_[first + 2][i]);
    };
    return {vector(0), vector(3), vector(6), vector(9)};
  }
  /// Stores the starting point number `i`, below `start_count`.
  void set(std::size_t i, const MapStart& start);
  bool operator==(const MapStarts&) const = default;

 private:
  std::array<std::array<float, start_count>, 12> numbers_{};
};

/// Computes the starting points of a map that is otherwise complete.
MapStarts spread_starts(const ReflectorMap& map, const ReflectorMesh& mesh, const ReflectorPatch& patch);

}  // namespace parvis::reflector_maps
