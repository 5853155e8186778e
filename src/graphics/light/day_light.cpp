#include "graphics/light/day_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/colour.h"
#include "base/parallel.h"
#include "graphics/light/atmosphere.h"
#include "graphics/light/cloud_cover.h"
#include "graphics/light/shadow_settings.h"
#include "graphics/shading/sky.h"
#include "scene/data/lamp.h"

namespace parvis::light {
namespace {

/// A clear sky is smooth.
constexpr int clear_width_px = 512;
/// Clouds keep the resolution of their photograph, within limits.
int picture_width_px(const DayLight& day) {
  return day.dome ? std::clamp(day.dome->width, clear_width_px, 2048) : clear_width_px;
}

/// Photocells of street lamps switch at some 60 lux.
constexpr float lamps_on = float(60.0 / lumens_per_watt);
/// Eyes in a lit street adapt to its lamps: EN 13201 has 7.5 lux on average for streets of houses,
/// 10 to 20 for those of shops.
constexpr float lit_street = float(7.5 / lumens_per_watt);

/// A picture of all directions; `colour_at` gets one, and where it lies in the picture.
template <class ColourAt>
ImageF equirectangular(int width_px, const ColourAt& colour_at) {
  ImageF picture(width_px, width_px / 2, 3);
  parallel_for(
      std::size_t(picture.height),
      [&](std::size_t row) {
        const float v = (float(row) + 0.5f) / float(picture.height), polar = v * 3.14159265f;
        const float across = std::sin(polar), up = std::cos(polar);
        for (int x = 0; x < picture.width; ++x) {
          const float u = (float(x) + 0.5f) / float(picture.width), azimuth = (u - 0.5f) * 6.2831853f;
          const glm::vec3 colour = colour_at(
              glm::vec3(across * std::sin(azimuth), across * std::cos(azimuth), up), glm::vec2(u, v));
          for (int c = 0; c < 3; ++c) picture.at(x, int(row))[c] = colour[c];
        }
      },
      4);
  return picture;
}

ImageF clear_sky(const SkyModel& sky, int width_px) {
  return equirectangular(
      width_px, [&](glm::vec3 direction, glm::vec2) { return displayable(sky.sky_radiance_xyz(direction)); });
}

}  // namespace

void DayLight::hash(ContentHash& hash) const {
  for (const double value :
       {when.latitude_deg, when.longitude_deg, when.time_zone_h, when.time_of_day_h, when.true_north_deg,
        air.turbidity, air.ground_albedo, double(dome_heading), double(chosen_exposure)})
    hash.add(value);
  for (const int value : {int(is_given), when.year, when.day_of_year, int(kind)}) hash.add(value);
  hash.add_text(dome_file.string());
}

float exposure_for(float illuminance) {
  constexpr float noon = 146.0f;      // 100,000 lux
  constexpr float minimum = 3e-4f;    // 0.2 lux: eyes see no colour below
  constexpr float displayed = 10.0f;  // illuminance times exposure at noon, as Parvis's other scenes have it
  constexpr float unadapted = 0.2f;   // power of what adaptation leaves
  const float light = std::max(illuminance, minimum);
  return displayed / light * std::pow(light / noon, unadapted);
}

ImageF sky_picture(const SkyModel& sky, const DayLight& day, int width_px) {
  if (!day.dome) return clear_sky(sky, width_px);
  const CloudLight clouds(sky, day.air, *day.dome, day.dome_heading);
  shading::SkyLight behind;  // is smooth: clouds alone take all pixels
  behind.levels.push_back(clear_sky(sky, std::min(width_px, clear_width_px)));
  return equirectangular(width_px, [&](glm::vec3 direction, glm::vec2 uv) {
    return clouds.with_dome(shading::sky_picture_at(behind, uv), direction);
  });
}

void adapt(scene::Scene& scene) {
  DayLight& day = scene.data<DayLight>();
  if (!day.is_given) return;
  const bool has_lamps = scene.data<scene::Darkness>().is_dark && !scene.items<scene::Lamp>().empty();
  day.adaptation = exposure_for(day.illuminance + (has_lamps ? lit_street : 0.0f));
  scene.exposure = day.chosen_exposure * day.adaptation;
}

Status light_scene(scene::Scene& scene) {
  DayLight& day = scene.data<DayLight>();
  if (!day.is_given) return Ok{};
  day.when.true_north_deg = scene.true_north_deg;
  if (Status status = check(day.when); !status) return status.errors();
  Result<std::shared_ptr<const SkyModel>> made = make_sky(day.kind, day.air, sun_of(day.when));
  if (!made) return made.errors();
  const SkyModel& sky = **made;
  set_sun(scene, {sky.to_sun(), displayable(sky.sun_irradiance_xyz())});
  scene.sky.picture = sky_picture(sky, day, picture_width_px(day));
  scene.sky.intensity = 1.0f, scene.sky.heading = 0.0f;
  ContentHash content;
  day.hash(content);
  scene.sky.version = int(content.value());
  day.illuminance = sky.irradiance_xyz({0, 0, 1}).y;
  scene.data<scene::Darkness>().is_dark = day.illuminance < lamps_on;
  adapt(scene);
  return Ok{};
}

}  // namespace parvis::light
