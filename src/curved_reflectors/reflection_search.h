// C++ face of reflection_point.glsl, midpoint_search.glsl and newton_search.glsl: the shaders' own searches
// over any reflector.
#pragma once

#include "shading/glsl.h"

namespace parvis::curved_reflectors {

using namespace shading;  // vec2, sign and the like, which shared files take for granted

/// `Reflector::surface(vec3 direction)` gives position and unit normal where a ray from the centre meets the
/// reflector, as `std::pair<vec3, vec3>`.
template <class Reflector>
struct ReflectionSearch {
  const Reflector& reflector;

#undef GLSL_FUNCTION
#define GLSL_FUNCTION
#include "curved_reflectors/reflection_point.glsl"
  // The others need the first: lines between them keep clang-format from sorting.
#include "curved_reflectors/midpoint_search.glsl"
  //
#include "curved_reflectors/newton_search.glsl"

  SurfacePoint surface_at(vec3 direction) {
    const auto [position, normal] = reflector.surface(direction);
    return {position, normal};
  }
};

#undef GLSL_FUNCTION
#define GLSL_FUNCTION inline

}  // namespace parvis::curved_reflectors
