// The open share of the sky over a fixed place, baked from its heights seen from above: for each cell of air,
// how high the surroundings stand in each direction of the compass. The C++ face of sky_visibility.glsl.
#pragma once

#include <cstdint>
#include <vector>

#include "base/bounds.h"
#include "graphics/shading/glsl.h"
#include "graphics/shading/heightfield.h"

namespace parvis::shading {
#include "graphics/shading/sky_visibility.glsl"

/// The grid that `sky_visibility_coordinates` addresses, x fastest, then y, then z.
struct SkyVisibility {
  SkyVisibilityGrid grid{glm::vec3(0.0f), glm::vec3(1.0f), 0.0f};
  glm::ivec3 cells{1};
  std::vector<std::uint8_t> values{128, 128, 128, 255};  ///< 4 a cell; one open cell: nothing hides the sky

  /// Trilinear, clamped to the edge, as a texture unit gives it.
  glm::vec4 at(glm::vec3 coordinates) const;
};

/// The model of light that surfaces reflect onto each other.
enum class WallLight : std::uint8_t {
  constant,  ///< walls and ground give back a share of the sky that they see
  none       ///< it is added elsewhere: shading/bounced_light.h
};

/// Cells of about 4 x 4 x 3 m. An empty place is open.
SkyVisibility make_sky_visibility(const Heightfield& heights, WallLight walls = WallLight::constant);

/// The distance from a cell within which heights are considered.
inline constexpr float sky_visibility_reach_m = 75.0f;

/// Brings `visibility` up to date where heights changed within `changed`: computes only cells near it, unless
/// the place's bounds are others now.
void renew_sky_visibility(SkyVisibility& visibility, const Heightfield& heights, const Bounds& changed,
                          WallLight walls = WallLight::constant);

}  // namespace parvis::shading
