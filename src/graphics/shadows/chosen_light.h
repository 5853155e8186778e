// The light of a scene with the method of shadows that its node shadowMap asks for; it may ask for another at
// any time.
#pragma once

#include <cstdint>
#include <memory>

#include "graphics/light/shadow_settings.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/light/sun_shadow_maps.h"
#include "graphics/render/light_source.h"
#include "graphics/shadows/traced_sun.h"

namespace parvis::shadows {

/// All methods in one. Each has the renderer's far map, for what the near map does not hold and for
/// reflections; the method places the near map, and `rays` replaces both for the pixels of main views.
class ChosenShadows final : public render::ShadowMethod {
 public:
  ChosenShadows(const scene::Scene& scene, const Bounds& fixed);

  /// Takes over the settings. True where they differ from those of the last frame.
  bool choose(const scene::Scene& scene);

  void renew(const render::FixedChange& change, const Bounds& fixed) override;
  void update(const Camera& camera, const scene::SunLight& sun, std::span<const Bounds> moving,
              const render::DrawView& draw) override;
  void cast_held(const Bounds& casters, const render::DrawView& draw) override {
    if (casts()) maps_->cast_held(casters, draw);
  }
  render::TracedSun trace_view(const Camera& camera, int width, int height) override;
  void bind() const override { maps_->bind(); }
  const shading::ShadowMaps& maps() const override { return maps_->maps(); }
  shading::SunShadow read_back() const override { return maps_->read_back(); }
  bool is_exact() const override { return settings_.technique == light::ShadowTechnique::rays; }

 private:
  bool casts() const { return settings_.technique != light::ShadowTechnique::none; }
  void make_maps();
  void follow(const scene::Scene& scene);

  light::ShadowSettings settings_;
  scene::SunLight sun_;
  Bounds fixed_;
  std::unique_ptr<light::SunShadowMaps> maps_;
  std::unique_ptr<reference::RayScene> followed_;  ///< null where the method needs no rays
  bool has_new_fixed_ = false;
  std::uint64_t scene_version_ = 0;
  std::vector<Bounds> moved_;  ///< since the view was traced
  TracedSun traced_;
};

/// The renderer's sun and sky, whose shadows are ChosenShadows.
class ChosenLight final : public render::LightSource {
 public:
  /// Creates the light, as render::MakeLight. Fails only if a shader does.
  static Result<std::unique_ptr<render::LightSource>> create(const scene::Scene& scene, const Bounds& fixed);

  bool update(const scene::Scene& scene) override {
    const bool has_other_shadows = shadows_->choose(scene);
    return light_->update(scene) || has_other_shadows;
  }
  /// Static things have changed.
  void renew(const scene::Scene& scene, const render::GpuScene& gpu, const render::FixedChange& change,
             const Bounds& fixed) override {
    light_->renew(scene, gpu, change, fixed);
  }
  /// Draws the maps of the method.
  void draw_shadows(const Camera& camera, std::span<const Bounds> moving,
                    const render::DrawView& draw) override {
    light_->draw_shadows(camera, moving, draw);
  }
  void cast_held(const Bounds& casters, const render::DrawView& draw) override {
    light_->cast_held(casters, draw);
  }
  render::TracedSun trace_view(const Camera& camera, int width, int height) override {
    return light_->trace_view(camera, width, height);
  }
  void bind() const override { light_->bind(); }
  void fill(render::Frame& frame) const override { light_->fill(frame); }
  void draw_sky(const render::View& view) const override { light_->draw_sky(view); }
  const shading::SkyLight& sky() const override { return light_->sky(); }
  const shading::SkyVisibility& sky_visibility() const override { return light_->sky_visibility(); }
  shading::DrawnLight drawn_light(const shading::BodyShade& body_shade) const override {
    return light_->drawn_light(body_shade);
  }

 private:
  ChosenLight(std::unique_ptr<render::LightSource> light, ChosenShadows* shadows)
      : light_(std::move(light)), shadows_(shadows) {}

  std::unique_ptr<render::LightSource> light_;
  ChosenShadows* shadows_;  ///< the light's own
};

}  // namespace parvis::shadows
