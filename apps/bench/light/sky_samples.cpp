#include "bench/light/sky_samples.h"

#include <algorithm>
#include <cmath>

#include "graphics/light/sun_and_sky.h"
#include "graphics/light/test_drawn_sky_check.h"
#include "graphics/render/frame_views.h"

namespace parvis::bench {

using light::SkyKind;

bool has_light(double sun_elevation_deg, bool is_above_horizon) {
  constexpr double last_twilight_deg = -4.0, rounding_deg = 1e-3;
  return sun_elevation_deg > rounding_deg ||
         (is_above_horizon && sun_elevation_deg > last_twilight_deg - rounding_deg);
}

void SkySamples::add(glm::vec3 radiance, bool has_light) {
  const bool is_radiance = radiance.x >= 0.0f && radiance.y >= 0.0f && radiance.z >= 0.0f &&
                           std::isfinite(radiance.x + radiance.y + radiance.z);
  const bool is_black = has_light && radiance == glm::vec3(0.0f);
  ++all, bad += !is_radiance || is_black;
}

light::SolarPosition sun_at(double elevation_deg) {
  return {.azimuth_deg = 180.0, .zenith_deg = 90.0 - elevation_deg, .geometric_elevation_deg = elevation_deg};
}

glm::vec3 even_direction(int number, int count) {
  const float z = 1.0f - 2.0f * (float(number) + 0.5f) / float(count), turn = 2.39996323f * float(number);
  const float across = std::sqrt(1.0f - z * z);
  return {across * std::cos(turn), across * std::sin(turn), z};
}

Result<ModelSamples> model_samples(int directions) {
  constexpr float less = 1e-4f;  // W/m2/sr, 0.07 cd/m2: what the control takes away
  ModelSamples samples;
  const auto look = [&](SkyKind kind, const light::Air& air, double elevation) -> Status {
    const auto sky = light::make_sky(kind, air, sun_at(elevation));
    if (!sky) return sky.errors();
    for (int i = 0; i < directions; ++i) {
      const glm::vec3 direction = even_direction(i, directions), seen = (*sky)->sky_radiance_xyz(direction);
      samples.shipped.add(seen, has_light(elevation, direction.z > 0.0f));
      samples.darker.add(seen - less, false);
    }
    return Done{};
  };
  for (const double turbidity : {1.0, 1.1, 1.3, 1.5, 1.645, 1.8, 2.0, 3.0, 6.0, 11.5, 20.0, 64.0})
    for (const double albedo : {0.0, 0.2, 1.0})
      for (const double elevation : {-90.0, -18.0, -8.0, -4.0, -1.0, 0.0, 1.0, 5.0, 20.0, 60.0, 90.0})
        for (const SkyKind kind : {SkyKind::atmosphere, SkyKind::preetham})
          if (Status status = look(kind, {turbidity, albedo}, elevation); !status) return status.errors();
  return samples;
}

Result<DrawnSky> DrawnSky::create() {
  scene::Scene scene;
  auto renderer = render::Renderer::create(scene, {}, light::sun_and_sky);
  if (!renderer) return renderer.errors();
  return DrawnSky(std::move(scene), *std::move(renderer));
}

Result<SkySamples> DrawnSky::samples(const light::SkyModel& sky, const light::DayLight& day) {
  constexpr int view_px = 96, picture_px = 512, upward_face = 5;
  const double sun_deg = glm::degrees(std::asin(std::clamp(double(sky.to_sun().z), -1.0, 1.0)));
  scene_.sun = {sky.to_sun(), glm::vec3(1.0f)};
  scene_.sky.picture = light::sky_picture(sky, day, picture_px);
  scene_.sky.file = "computed", ++scene_.sky.version;
  SkySamples samples;
  for (int face = 0; face < 6; ++face) {
    if (Status status = render::draw_frame(*renderer_, scene_, {light::view_of_sky(face), view_px, view_px});
        !status)
      return status.errors();
    const ImageF seen = renderer_->read_radiance();
    for (std::size_t i = 0; i < seen.pixels.size(); i += std::size_t(seen.channels))
      samples.add({seen.pixels[i], seen.pixels[i + 1], seen.pixels[i + 2]},
                  has_light(sun_deg, face == upward_face));
  }
  return samples;
}

}  // namespace parvis::bench
