#include "graphics/light/sun_and_sky.h"

#include <cmath>

#include "graphics/light/sun_shadow_maps.h"

namespace parvis::light {

Result<std::unique_ptr<render::LightSource>> SunAndSky::create(
    const scene::Scene& scene, const Bounds& fixed, std::unique_ptr<render::ShadowMethod> shadows) {
  Result<SkyTextures> sky = SkyTextures::create(scene);
  if (!sky) return sky.errors();
  return std::unique_ptr<render::LightSource>(
      new SunAndSky(scene, fixed, *std::move(sky), std::move(shadows)));
}

bool SunAndSky::update(const scene::Scene& scene) {
  const scene::SunLight sun = scene::sun_light(scene);
  const bool has_new_sun = sun != sun_ || scene.haze_per_m != haze_per_m_;
  sun_ = sun;
  haze_per_m_ = scene.haze_per_m;
  inserted_.update(scene);
  return sky_.renew_light(scene.sky) || has_new_sun;
}

void SunAndSky::renew(const scene::Scene& scene, const render::GpuScene& gpu,
                      const render::FixedChange& change, const Bounds& fixed) {
  shadows_->renew(change, fixed);
  inserted_.renew(change, fixed);
  sky_.renew_visibility(scene, gpu, change);
}

void SunAndSky::bind() const {
  sky_.bind();
  shadows_->bind();
  inserted_.bind();
}

void SunAndSky::fill(render::Frame& frame) const {
  frame.frame_to_sun = glm::vec4(glm::normalize(sun_.direction_to_sun), haze_per_m_);
  frame.frame_sun_irradiance = glm::vec4(sun_.irradiance, 0.0f);
  frame.frame_spot = sun_.spot ? glm::vec4(sun_.spot->position, std::cos(sun_.spot->half_angle))
                               : glm::vec4(0.0f, 0.0f, 0.0f, -2.0f);
  const shading::SkyLight& sky = sky_.light();
  frame.frame_haze = glm::vec4(sky.haze_radiance, sky.heading);
  for (std::size_t i = 0; i < 9; ++i) frame.frame_sky_sh[i] = glm::vec4(sky.irradiance_sh[i], 0.0f);
  frame.frame_size.z = float(sky.levels.size());
  const shading::ShadowMaps& maps = shadows_->maps();
  for (int i = 0; i < 2; ++i) frame.frame_uvz_from_world[i] = maps.uvz_from_world[i];
  frame.frame_shadow_texel = glm::vec4(maps.texel_m, maps.texel_uv, maps.growth);
  for (int i = 0; i < shading::max_shadow_tiles; ++i) frame.frame_shadow_tiles[i] = maps.tiles[i];
  inserted_.fill(frame);
  frame.frame_shadow_extra.x = float(maps.tile_count);
  const shading::SkyVisibilityGrid& grid = sky_.visibility().grid;
  frame.frame_visibility_origin = glm::vec4(grid.origin, grid.lift_m);
  frame.frame_visibility_size = glm::vec4(grid.size_m, 0.0f);
  frame.frame_lamps = glm::vec4(0.0f, 0.0f, 1.0f, 0.0f);  // none: sources above fill these
}

Result<std::unique_ptr<render::LightSource>> sun_and_sky(const scene::Scene& scene, const Bounds& fixed) {
  return SunAndSky::create(scene, fixed, std::make_unique<SunShadowMaps>(scene::sun_light(scene), fixed));
}

}  // namespace parvis::light
