// The open share of the sky over a fixed place, baked from its heights seen from above: for each cell of air,
// how high the surroundings stand in each direction of the compass. The C++ face of sky_visibility.glsl.
#pragma once

#include <cstdint>
#include <vector>

#include "base/bounds.h"
#include "base/image.h"
#include "base/mesh.h"
#include "shading/glsl.h"

namespace parvis::shading {
#include "shading/sky_visibility.glsl"

/// The highest point of what stands on each square of the ground.
class HeightField {
 public:
  /// Over the horizontal extent of `bounds`, squares of about a metre (larger where the place is huge).
  explicit HeightField(const Bounds& bounds);
  /// Raises the squares that a mesh covers. Leave out what light passes: leaves, railings.
  void add(const Mesh& mesh, const glm::mat4& world_from_mesh);

  /// Metres at a point of the ground; the place's lowest height outside of it.
  float height_m(glm::vec2 position) const;
  const Bounds& bounds() const { return bounds_; }

 private:
  void add_triangle(const glm::vec3 (&corners)[3]);

  Bounds bounds_;
  float square_m_ = 1.0f;
  ImageF heights_;  ///< row 0 is south
};

/// The grid that `sky_visibility_coordinates` addresses, x fastest, then y, then z.
struct SkyVisibility {
  SkyVisibilityGrid grid{glm::vec3(0.0f), glm::vec3(1.0f), 0.0f};
  glm::ivec3 cells{1};
  std::vector<std::uint8_t> values{128, 128, 128, 255};  ///< 4 a cell; one open cell: nothing hides the sky

  /// Trilinear, clamped to the edge, as a texture unit gives it.
  glm::vec4 at(glm::vec3 coordinates) const;
};

/// Cells of about 4 x 4 x 3 m. An empty place is open.
SkyVisibility make_sky_visibility(const HeightField& heights);

/// Brings `visibility` up to date where heights changed within `changed`: computes only cells near it, unless
/// the place's bounds are others now.
void renew_sky_visibility(SkyVisibility& visibility, const HeightField& heights, const Bounds& changed);

}  // namespace parvis::shading
