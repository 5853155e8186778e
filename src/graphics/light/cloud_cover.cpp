#include "graphics/light/cloud_cover.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "base/colour.h"
#include "graphics/light/atmosphere.h"

namespace parvis::light {
namespace {

constexpr double cloud_height_m = 2000.0;
/// Albedo of a cumulus, its lit and its shaded side taken together, and of land.
constexpr float cloud_albedo = 0.4f, land_albedo = 0.2f;
/// Mean luminance of what a photograph shows.
struct Means {
  float cloud, land;
};

glm::vec3 pixel(const ImageF& picture, int x, int y) {
  const float* p =
      picture.at((x % picture.width + picture.width) % picture.width, std::clamp(y, 0, picture.height - 1));
  return {p[0], p[1], p[2]};
}

glm::vec3 bilinear(const ImageF& picture, float u, float v) {
  const float x = u * float(picture.width) - 0.5f, y = v * float(picture.height) - 0.5f;
  const int left = int(std::floor(x)), top = int(std::floor(y));
  const float fx = x - float(left), fy = y - float(top);
  return glm::mix(glm::mix(pixel(picture, left, top), pixel(picture, left + 1, top), fx),
                  glm::mix(pixel(picture, left, top + 1), pixel(picture, left + 1, top + 1), fx), fy);
}

Means means_of(const ImageF& dome) {
  double cloud = 0.0, cover = 1e-6, land = 0.0, pixels = 1e-6;
  const int step = std::max(1, dome.height / 64);
  for (int y = 0; y < dome.height; y += step)
    for (int x = 0; x < dome.width; x += step) {
      const glm::vec3 colour = pixel(dome, x, y);
      const double weight = std::sin((y + 0.5) / dome.height * double(glm::pi<float>())),
                   light = std::min(double(luminance(colour)), 1e3);
      if (y < dome.height / 2) {
        cloud += weight * double(cloud_share(colour)) * light, cover += weight * double(cloud_share(colour));
      } else {
        land += weight * light, pixels += weight;
      }
    }
  return {float(std::max(cloud / cover, 1e-6)), float(std::max(land / pixels, 1e-6))};
}

}  // namespace

float cloud_share(glm::vec3 colour) {
  const float maximum = std::max({colour.x, colour.y, colour.z, 1e-9f});
  const float saturation = 1.0f - std::min({colour.x, colour.y, colour.z}) / maximum;
  return glm::smoothstep(0.5f, 0.22f, saturation);
}

CloudLight::CloudLight(const SkyModel& sky, const Air& air, const ImageF& dome, float heading)
    : dome_(dome), heading_(heading), to_sun_(sky.to_sun()) {
  const Means means = means_of(dome);
  mean_cloud_ = means.cloud, mean_land_ = means.land;
  const Spectrum high = sunlight(AirCoefficients(air), ground_radius_m + cloud_height_m, double(to_sun_.z));
  sun_ = displayable(glm::vec3(xyz(high)));
  const glm::vec3 level = sky.irradiance_xyz({0, 0, 1}),
                  direct = std::max(to_sun_.z, 0.0f) * sky.sun_irradiance_xyz();
  sky_ = displayable(level - direct);
  ground_ = displayable(level);
}

glm::vec3 CloudLight::with_dome(glm::vec3 clear, glm::vec3 direction) const {
  const float u = 0.5f + (std::atan2(direction.x, direction.y) - heading_) / (2.0f * glm::pi<float>());
  const glm::vec3 seen =
      bilinear(dome_, u - std::floor(u), std::acos(std::clamp(direction.z, -1.0f, 1.0f)) / glm::pi<float>());
  if (direction.z <= 0.0f) return seen / mean_land_ * land_albedo / glm::pi<float>() * ground_;
  // Clouds let light through toward the viewer when they stand before the sun; a low sun lights their sides.
  const float through = 0.5f + 0.9f * std::pow(std::max(glm::dot(direction, to_sun_), 0.0f), 6.0f);
  const float lit = 0.45f + 0.55f * std::sqrt(std::max(to_sun_.z, 0.0f));
  const float shape = std::min(luminance(seen) / mean_cloud_, 2.0f);
  const glm::vec3 cloud = cloud_albedo / glm::pi<float>() * shape * (through * lit * sun_ + 0.9f * sky_);
  const float near_horizon =
      glm::smoothstep(0.02f, 0.10f, direction.z);  // haze looks like cloud there, and hides it
  return glm::mix(clear, cloud, cloud_share(seen) * near_horizon);
}

}  // namespace parvis::light
