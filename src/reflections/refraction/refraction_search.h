// C++ side of glass_rays.glsl and refraction_search.glsl: the shaders' search through any convex body, and
// its starting rays.
#pragma once

#include <array>
#include <functional>

#include "graphics/shading/glass.h"
#include "reflections/reflection_search/map_window.h"

namespace parvis::refraction {
using namespace reflection_search;

#include "reflections/refraction/refraction_limits.glsl"
inline constexpr std::size_t refraction_ray_count = refraction_start_count;

/// A convex body of glass: position and outward unit normal of the surface along a ray from its centre.
struct GlassBody {
  std::function<std::pair<glm::vec3, glm::vec3>(glm::vec3 direction)> surface;
  glm::vec3 centre{0.0f};
  float reach = 1.0f;  ///< maximum distance of the surface from the centre
  float ior = 1.5f;
};

/// Rays from an outside viewer through the body, spread over its visible surface: starting points of searches
/// (`refraction_start` of refraction_search.glsl). They depend on the viewer alone.
std::array<glm::mat4, refraction_ray_count> refraction_rays(const GlassBody& body, glm::vec3 viewer);

/// The search of the shaders; `Body::surface(vec3 direction)` as in GlassBody.
template <class Body>
struct RefractionSearch {
  const Body& body;
  std::array<glm::mat4, refraction_ray_count> rays{};

#include "reflections/reflection_search/surface_point.glsl"
  // Each needs those before it: lines between them keep clang-format from sorting.
#include "reflections/refraction/glass_rays.glsl"
  //
#include "reflections/refraction/refraction_search.glsl"

  SurfacePoint surface_at(vec3 direction) {
    const auto [position, normal] = body.surface(direction);
    return {position, normal, kind_surface};
  }
  /// Starting ray number `i`; called by the included shader code.
  mat4 refraction_start(int i) { return rays[std::size_t(i)]; }
};

}  // namespace parvis::refraction
