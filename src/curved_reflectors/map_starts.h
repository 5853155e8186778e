// Where searches over a reflector map may begin: places spread over its patch, and how the surface bends
// about each.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "curved_reflectors/reflector_patches.h"

namespace parvis::curved_reflectors {

struct ReflectorMap;

inline constexpr std::size_t layer_start_count = 16, start_count = 64;  ///< as in patch_search.glsl

/// A place, and how the surface bends about it, in the tangent plane of `normal` and `u` (patch_search.glsl).
struct MapStart {
  glm::vec3 position, normal, u, bend;
  bool operator==(const MapStart&) const = default;
};

/// The first near the patch's middle, each of the others as far as can be from those before: any number of
/// the first are spread over it. The map has all but its starts.
std::array<MapStart, start_count> spread_starts(const ReflectorMap& map, const ReflectorMesh& mesh,
                                                const ReflectorPatch& patch);

}  // namespace parvis::curved_reflectors
