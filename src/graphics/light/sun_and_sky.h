// The light of a scene with one sun and the picture of a sky: Scene::sun, sky and haze_per_m, taken over in
// every frame. A computed sky that changes with the time of day writes its picture and counts
// scene::Sky::version up.
#pragma once

#include <memory>

#include "graphics/light/inserted_shadows.h"
#include "graphics/light/sky_textures.h"
#include "graphics/render/light_source.h"

namespace parvis::light {

class SunAndSky final : public render::LightSource {
 public:
  /// Fails only if a shader does.
  static Result<std::unique_ptr<render::LightSource>> create(const scene::Scene& scene, const Bounds& fixed,
                                                             std::unique_ptr<render::ShadowMethod> shadows);

  bool update(const scene::Scene& scene) override;
  void renew(const scene::Scene& scene, const render::GpuScene& gpu, const render::FixedChange& change,
             const Bounds& fixed) override;
  void draw_shadows(const Camera& camera, std::span<const Bounds> moving,
                    const render::DrawView& draw) override {
    shadows_->update(camera, sun_, moving, draw);
    inserted_.draw(camera, sun_, moving, draw);
  }
  void cast_held(const Bounds& casters, const render::DrawView& draw) override {
    shadows_->cast_held(casters, draw);
  }
  render::TracedSun trace_view(const Camera& camera, int width, int height) override {
    return shadows_->trace_view(camera, width, height);
  }
  void bind() const override;
  void fill(render::Frame& frame) const override;
  void draw_sky(const render::View& view) const override { sky_.draw(view); }
  const shading::SkyLight& sky() const override { return sky_.light(); }
  const shading::SkyVisibility& sky_visibility() const override { return sky_.visibility(); }
  shading::DrawnLight drawn_light(const shading::BodyShade& body_shade) const override {
    shading::DrawnLight drawn{shadows_->read_back(), &sky_.visibility(), &body_shade, shadows_->is_exact()};
    drawn.inserted_shadow = inserted_.read_back();
    return drawn;
  }

 private:
  SunAndSky(const scene::Scene& scene, const Bounds& fixed, SkyTextures sky,
            std::unique_ptr<render::ShadowMethod> shadows)
      : sun_(scene::sun_light(scene)),
        haze_per_m_(scene.haze_per_m),
        sky_(std::move(sky)),
        shadows_(std::move(shadows)),
        inserted_(fixed) {}

  scene::SunLight sun_;
  float haze_per_m_;
  SkyTextures sky_;
  std::unique_ptr<render::ShadowMethod> shadows_;
  InsertedShadows inserted_;
};

/// SunAndSky with SunShadowMaps about the viewer: a render::MakeLight.
Result<std::unique_ptr<render::LightSource>> sun_and_sky(const scene::Scene& scene, const Bounds& fixed);

}  // namespace parvis::light
