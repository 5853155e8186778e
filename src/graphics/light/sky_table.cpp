#include "graphics/light/sky_table.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "graphics/shading/octahedral.h"
#include "graphics/shading/sky.h"
#include "graphics/shading/spherical_harmonics.h"
#include "scene/data/scene.h"

namespace parvis::light {
namespace {}  // namespace

SkyTable::SkyTable(const SkyModel& sky)
    : to_sun_(sky.to_sun()), sun_irradiance_(displayable(sky.sun_irradiance_xyz())) {
  fill([&](glm::vec3 direction) { return displayable(sky.sky_radiance_xyz(direction)); });
}

SkyTable::SkyTable(const scene::Scene& scene)
    : to_sun_(glm::normalize(scene.sun.direction_to_sun)),
      sun_irradiance_(scene.sun.irradiance),
      spot_(scene.data<scene::SunShadows>().spot) {
  const scene::Sky& sky = scene.sky;
  shading::SkyLight light;
  if (sky.picture.empty())
    light = shading::make_sky_light({}, 1.0f, sky.heading);
  else  // blurred levels, which take most of the time of a new sky, are for reflections
    light.levels.push_back(sky.picture), light.heading = sky.heading;
  fill([&](glm::vec3 direction) { return sky.intensity * shading::sky_radiance(light, direction, 0.0f); });
}

void SkyTable::fill(const std::function<glm::vec3(glm::vec3 direction)>& radiance) {
  texels_.resize(std::size_t(side) * side);
  const auto direction_of = [](std::size_t i) {
    const int row = int(i) / side, column = int(i) % side;
    const glm::vec2 uv = (glm::vec2(float(column), float(row)) + 0.5f) / float(side);
    return shading::octahedral_direction(uv);
  };
  parallel_for(
      texels_.size(), [&](std::size_t i) { texels_[i] = radiance(direction_of(i)); }, 256);
  // A texel of the octahedron |x| + |y| + |z| = 1 stands for a solid angle that grows with 1 / distance^3
  // from its middle.
  float sphere = 0.0f;
  for (std::size_t i = 0; i < texels_.size(); ++i) {
    const glm::vec3 d = direction_of(i);
    const float one_norm = std::abs(d.x) + std::abs(d.y) + std::abs(d.z),
                weight = one_norm * one_norm * one_norm;
    const std::array<float, 9> basis = shading::sh_basis(d);
    for (std::size_t k = 0; k < 9; ++k) sh_[k] += weight * shading::cosine_lobe[k] * basis[k] * texels_[i];
    sphere += weight;
  }
  for (glm::vec3& coefficient : sh_) coefficient *= 12.566371f / sphere;
}

glm::vec3 SkyTable::irradiance(glm::vec3 normal) const {
  std::array<glm::vec3, 9> sh = sh_;
  return shading::sky_irradiance(sh.data(), normal);
}

glm::vec3 SkyTable::radiance(glm::vec3 direction) const {
  const glm::vec2 at = shading::octahedral_uv(direction) * float(side);
  const int x = std::clamp(int(at.x), 0, side - 1), y = std::clamp(int(at.y), 0, side - 1);
  return texels_[std::size_t(y) * side + std::size_t(x)];
}

}  // namespace parvis::light
