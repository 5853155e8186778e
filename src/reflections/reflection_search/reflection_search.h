// C++ face of reflection_point.glsl, midpoint_search.glsl and newton_search.glsl: the shaders' own searches
// over any reflector.
#pragma once

#include <cstddef>

#include "reflections/reflection_search/map_window.h"

namespace parvis::reflection_search {
#include "reflections/reflection_search/search_limits.glsl"

/// `Reflector::surface(vec3 direction)` gives position and unit normal where a ray from the centre meets the
/// reflector, as `std::pair<vec3, vec3>`; or `Reflector::sample(vec3 direction)` also what is there. For
/// `search_patch` it has `starts`, as a ReflectorMap does.
template <class Reflector>
struct ReflectionSearch {
  const Reflector& reflector;

#include "reflections/reflection_search/surface_point.glsl"
  // Each needs those before it: lines between them keep clang-format from sorting.
#include "reflections/reflection_search/reflection_point.glsl"
  //
#include "reflections/reflection_search/midpoint_search.glsl"
  //
#include "reflections/reflection_search/newton_search.glsl"
  //
#include "reflections/reflection_search/patch_search.glsl"

  MapWindow map_window() const {
    if constexpr (requires { reflector.window; }) return reflector.window;
    return all_directions;
  }
  SurfacePoint surface_at(vec3 direction) {
    if constexpr (requires { reflector.sample(direction); }) {
      const auto [position, normal, kind] = reflector.sample(direction);
      return {position, normal, kind};
    } else {
      const auto [position, normal] = reflector.surface(direction);
      return {position, normal, kind_surface};
    }
  }
  SearchStart search_start(int i) {
    const auto [position, normal, u, curvature] = reflector.starts[std::size_t(i)];
    return {{{position, normal, kind_surface}, u, cross(normal, u)}, curvature};
  }
  SearchStart further_start(int i) { return search_start(i); }
  /// The kind of patch of a ReflectorMap.
  PatchKind patch_kind() const { return {reflector.is_convex, reflector.is_whole_body()}; }
};

}  // namespace parvis::reflection_search
