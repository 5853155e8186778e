// A light that adds something to another: lamps, bounced light. A room above wraps the light that
// render::Lights had before, and overrides what it adds.
#pragma once

#include <memory>
#include <utility>

#include "graphics/render/light_source.h"

namespace parvis::render {

/// Hands everything on to the light below.
class LightOver : public LightSource {
 public:
  explicit LightOver(std::unique_ptr<LightSource> below) : below_(std::move(below)) {}

  bool update(const scene::Scene& scene) override { return below_->update(scene); }
  void renew(const scene::Scene& scene, const GpuScene& gpu, const FixedChange& change,
             const Bounds& fixed) override {
    below_->renew(scene, gpu, change, fixed);
  }
  void draw_shadows(const Camera& camera, std::span<const Bounds> moving, const DrawView& draw) override {
    below_->draw_shadows(camera, moving, draw);
  }
  void cast_held(const Bounds& casters, const DrawView& draw) override { below_->cast_held(casters, draw); }
  TracedSun trace_view(const Camera& camera, int width, int height) override {
    return below_->trace_view(camera, width, height);
  }
  void bind() const override { below_->bind(); }
  void fill(Frame& frame) const override { below_->fill(frame); }
  void draw_sky(const View& view) const override { below_->draw_sky(view); }
  const shading::SkyLight& sky() const override { return below_->sky(); }
  const shading::SkyVisibility& sky_visibility() const override { return below_->sky_visibility(); }
  const shading::LampTable* lamps() const override { return below_->lamps(); }
  const shading::BouncedLight* bounced() const override { return below_->bounced(); }
  shading::DrawnLight drawn_light(const shading::BodyShade& body_shade) const override {
    return below_->drawn_light(body_shade);
  }

 protected:
  /// The light over which this one is laid.
  const LightSource& below() const { return *below_; }

 private:
  std::unique_ptr<LightSource> below_;
};

}  // namespace parvis::render
