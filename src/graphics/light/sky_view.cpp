#include "graphics/light/sky_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"

namespace parvis::light {
namespace {

using namespace shading;

/// A height just above the ground, and a dip so far below level that a ray from there surely ends on it.
constexpr double viewer_height_m = 1.0, dip_rad = 0.0008;

/// Gives the shared functions the table that a shader has in a sampler.
struct Lookup {
  const glm::vec4* texels;

  vec3 sky_view_texel(int layer, ivec2 place) const {
    return vec3(texels[(layer * SkyView::rows + place.y) * SkyView::columns + place.x]);
  }
#include "graphics/light/sky_view.glsl"
};

}  // namespace

SkyView::SkyView(const Atmosphere& atmosphere, glm::vec3 to_sun)
    : to_sun_(to_sun), texels_(std::size_t(2 * rows * columns)) {
  const double mu = std::clamp(double(to_sun.z), -1.0, 1.0);
  const glm::dvec3 sun(std::sqrt(1.0 - mu * mu), 0.0, mu);
  parallel_for(rows, [&](std::size_t row) {
    const bool is_above = row < rows / 2;
    const double share = double(row % (rows / 2)) / (rows / 2 - 1),
                 elevation = 0.5 * std::numbers::pi * share * share;
    const double z = is_above ? std::sin(elevation) : -std::sin(std::max(elevation, dip_rad)),
                 across = std::sqrt(1.0 - z * z);
    for (int column = 0; column < columns; ++column) {
      const double turn = std::numbers::pi * column / (columns - 1);
      const Atmosphere::View seen =
          atmosphere.view(viewer_height_m, {across * std::cos(turn), across * std::sin(turn), z}, sun);
      const std::size_t place = row * columns + std::size_t(column);
      texels_[place] = glm::vec4(glm::vec3(xyz(seen.radiance)), 0.0f);
      texels_[rows * columns + place] = glm::vec4(glm::vec3(xyz(seen.haze_once)), 0.0f);
    }
  });
}

glm::vec3 SkyView::radiance_xyz(glm::vec3 direction) const {
  return Lookup{texels_.data()}.sky_view_radiance(direction, to_sun_);
}

}  // namespace parvis::light
