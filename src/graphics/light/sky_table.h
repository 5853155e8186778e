// A sky that is asked for many directions.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "graphics/light/sky_model.h"
#include "scene/data/scene.h"
#include "scene/data/sun_shadows.h"

namespace parvis::light {

/// Radiance of a sky in a table, linear Rec. 709.
class SkyTable {
 public:
  explicit SkyTable(const SkyModel& sky);
  /// The light of a scene as its renderer has it: Scene::sky, Scene::sun, and the lamp in the sun's place.
  explicit SkyTable(const scene::Scene& scene);
  /// Radiance of the sky without the sun's disc, from a unit direction.
  glm::vec3 radiance(glm::vec3 direction) const;
  /// Unit direction to the sun.
  glm::vec3 to_sun() const { return to_sun_; }
  /// Irradiance of the sun on a surface that faces it.
  glm::vec3 sun_irradiance() const { return sun_irradiance_; }
  /// A lamp in the sun's place, or none.
  const std::optional<scene::Spot>& spot() const { return spot_; }
  /// Irradiance of the open sky without the sun on a surface with unit `normal`.
  glm::vec3 irradiance(glm::vec3 normal) const;

 private:
  void fill(const std::function<glm::vec3(glm::vec3 direction)>& radiance);

  static constexpr int side = 128;  ///< of an octahedral map
  glm::vec3 to_sun_, sun_irradiance_;
  std::optional<scene::Spot> spot_;
  std::vector<glm::vec3> texels_;
  std::array<glm::vec3, 9> sh_{};  ///< shading/sky.glsl
};

}  // namespace parvis::light
