// C++ face of glass_rays.glsl and refraction_search.glsl: the shaders' own search through any convex body;
// and the rays that it begins with.
#pragma once

#include <array>
#include <functional>

#include "graphics/shading/glass.h"
#include "reflections/reflection_search/map_window.h"

namespace parvis::refraction {
using namespace reflection_search;

inline constexpr std::size_t refraction_ray_count = 37;  ///< as in refraction_search.glsl

/// A convex body of glass: position and outward unit normal where a ray from its centre meets its surface.
struct GlassBody {
  std::function<std::pair<glm::vec3, glm::vec3>(glm::vec3 direction)> surface;
  glm::vec3 centre{0.0f};
  float reach = 1.0f;  ///< the surface's greatest distance from the centre
  float ior = 1.5f;
};

/// Rays from a viewer outside through the body, spread over all that is seen of it: what searches begin with,
/// as `refraction_start` of refraction_search.glsl has them. They change with the viewer alone.
std::array<glm::mat4, refraction_ray_count> refraction_rays(const GlassBody& body, glm::vec3 viewer);

/// `Body::surface(vec3 direction)` as of a GlassBody.
template <class Body>
struct RefractionSearch {
  const Body& body;
  std::array<glm::mat4, refraction_ray_count> rays{};

#undef GLSL_FUNCTION
#define GLSL_FUNCTION
#include "reflections/reflection_search/surface_point.glsl"
  // Each needs those before it: lines between them keep clang-format from sorting.
#include "reflections/refraction/glass_rays.glsl"
  //
#include "reflections/refraction/refraction_search.glsl"

  SurfacePoint surface_at(vec3 direction) {
    const auto [position, normal] = body.surface(direction);
    return {position, normal, kind_surface};
  }
  mat4 refraction_start(int i) { return rays[std::size_t(i)]; }
};

#undef GLSL_FUNCTION
#define GLSL_FUNCTION inline

}  // namespace parvis::refraction
