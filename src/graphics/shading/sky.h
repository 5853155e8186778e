// Light from the sky: the picture prefiltered for glossy reflection and projected on spherical harmonics,
// made once when a scene is loaded, for shaders and ray tracer alike.
#pragma once

#include <array>
#include <vector>

#include "base/image.h"
#include "graphics/shading/glsl.h"

namespace parvis::shading {
#include "graphics/shading/sky.glsl"

struct SkyLight {
  std::vector<ImageF>
      levels;  ///< level 0: the picture; level n: half as large, blurred for roughness n / (levels - 1)
  std::array<glm::vec3, 9> irradiance_sh{};  ///< convolved with the cosine lobe, in the world's frame
  glm::vec3 haze_radiance{0.0f};             ///< mean radiance just above the horizon
  float heading = 0.0f;                      ///< radians
};

/// A photograph of a whole sky (3 channels) with the sun's disc in it dimmed, for the scene's own sun shines
/// instead. Computed skies have no disc, and their glare is light of the sky.
ImageF without_sun(ImageF photograph);

/// `picture` is equirectangular with 3 channels, without the sun; it is scaled by `intensity` and turned by
/// `heading` (radians). An empty picture gives a plain blue sky.
SkyLight make_sky_light(const ImageF& picture, float intensity, float heading);

/// Radiance of the sky from a unit direction, at a level of blur (bilinear in the picture, linear between
/// levels).
glm::vec3 sky_radiance(const SkyLight& sky, glm::vec3 direction, float level);
/// The same at level 0, where `equirect_uv` says that a direction lies: for those who know that already.
glm::vec3 sky_picture_at(const SkyLight& sky, glm::vec2 uv);

}  // namespace parvis::shading
