// Samples of skies, all of which must be light: as the models have them, and as the renderer draws them.
#pragma once

#include <memory>
#include <utility>

#include "graphics/light/day_light.h"
#include "graphics/light/sky_model.h"
#include "graphics/render/renderer.h"

namespace parvis::bench {

/// Samples, and those of them that are no radiance: negative or no numbers, or black where a sky is not,
/// which is what clamps leave of negative ones.
struct SkySamples {
  long all = 0, bad = 0;

  /// Counts one, of radiance in any three channels.
  void add(glm::vec3 radiance, bool has_light);
};

/// Whether there is light: by day everywhere, in twilight down to -4 degrees above the horizon.
bool has_light(double sun_elevation_deg, bool is_above_horizon);

/// Where a sun stands that the models are asked for, in the south.
light::SolarPosition sun_at(double elevation_deg);

/// Unit direction `number` of `count` that are spread evenly over the sphere.
glm::vec3 even_direction(int number, int count);

/// Both models on the CPU, for all that a scene may ask of them; and the same samples, each a little darker.
struct ModelSamples {
  SkySamples shipped, darker;
};
/// So many directions of each sky.
Result<ModelSamples> model_samples(int directions);

/// A model of which some radiance is taken away, below zero where it has less: a control.
class DarkerSky final : public light::SkyModel {
 public:
  DarkerSky(std::shared_ptr<const light::SkyModel> sky, float less)
      : SkyModel(sky->to_sun(), sky->sun_irradiance_xyz()), sky_(std::move(sky)), less_(less) {}
  glm::vec3 sky_radiance_xyz(glm::vec3 direction) const override {
    return sky_->sky_radiance_xyz(direction) - less_;
  }

 private:
  std::shared_ptr<const light::SkyModel> sky_;
  float less_;
};

/// Skies as the renderer draws them, one after the other.
class DrawnSky {
 public:
  /// Fails if a shader does. Needs a current OpenGL context.
  static Result<DrawnSky> create();
  /// The pixels of six views that together show all directions, with the dome of `day` if it has one. Fails
  /// as render::draw_frame.
  Result<SkySamples> samples(const light::SkyModel& sky, const light::DayLight& day = {});

 private:
  DrawnSky(scene::Scene scene, std::unique_ptr<render::Renderer> renderer)
      : scene_(std::move(scene)), renderer_(std::move(renderer)) {}

  scene::Scene scene_;
  std::unique_ptr<render::Renderer> renderer_;
};

}  // namespace parvis::bench
