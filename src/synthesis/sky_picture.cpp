#include "synthesis/sky_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "base/colour.h"
#include "base/parallel.h"
#include "synthesis/noise.h"

namespace parvis::synthesis {
namespace {

constexpr float cloud_base_m = 1400.0f;
constexpr float haze_per_km =
    0.45f;  // somewhat more than over the city: what lies beyond must not stand out darker
const glm::vec3 horizon_radiance(0.66f, 0.78f, 0.94f);

glm::vec3 clear_sky(glm::vec3 direction, glm::vec3 to_sun) {
  const glm::vec3 zenith(0.09f, 0.24f, 0.62f), middle(0.22f, 0.46f, 0.90f);
  const float up = std::max(direction.z, 0.0f), cosine = std::clamp(glm::dot(direction, to_sun), -1.0f, 1.0f);
  glm::vec3 radiance = glm::mix(middle, zenith, std::pow(up, 0.6f));
  radiance = glm::mix(radiance, horizon_radiance, std::exp(-6.5f * up));
  const float glow =
      0.16f * std::pow(std::max(cosine, 0.0f), 6.0f) + 0.6f * std::pow(std::max(cosine, 0.0f), 90.0f);
  return radiance + glow * glm::vec3(1.0f, 0.93f, 0.8f);
}

/// Share of a point of the cloud layer that is cloud; `p` in kilometres.
float cloud_density(glm::vec2 p, float height, std::uint32_t seed) {
  // Cumulus is flat below and rounded above: the threshold rises with height.
  const float shape = fractal_noise(glm::vec3(0.8f * p, 0.35f * height), 3, seed) - 0.59f - 0.1f * height;
  constexpr float detail_share = 0.42f;
  if (shape < -0.5f * detail_share) return 0.0f;
  const float detail = fractal_noise(glm::vec3(2.3f * p, 1.3f * height), 4, seed + 20) - 0.5f;
  return std::clamp((shape + detail_share * detail) * 7.0f, 0.0f, 1.0f);
}

struct Cloud {
  glm::vec3 radiance{0.0f};
  float cover = 0.0f;
};

/// Marches through the layer, a few steps, with a look toward the sun at each.
Cloud clouds(glm::vec3 direction, glm::vec3 to_sun, std::uint32_t seed) {
  if (direction.z < 0.02f) return {};
  constexpr int steps = 24;
  const glm::vec3 sunlit(2.9f, 2.75f, 2.5f), shaded(0.62f, 0.70f, 0.84f);
  float through = 1.0f;
  glm::vec3 light(0.0f);
  for (int i = 0; i < steps && through > 0.03f; ++i) {
    const float height = (float(i) + 0.5f) / float(steps);  // 0..1 in the layer, 700 m thick
    const float distance_km = (0.001f * cloud_base_m + 0.7f * height) / (direction.z + 0.03f);
    const glm::vec2 p = distance_km * glm::vec2(direction);
    const float density = cloud_density(p, height, seed);
    if (density <= 0.0f) continue;
    const glm::vec2 toward_sun = glm::vec2(to_sun) / std::max(to_sun.z, 0.2f);
    const float before = cloud_density(p + 0.16f * toward_sun, height + 0.2f, seed) +
                         0.6f * cloud_density(p + 0.4f * toward_sun, height + 0.5f, seed);
    const float lit = std::exp(-1.5f * before) * (0.55f + 0.45f * height);
    const float step = 1.0f - std::exp(-0.53f * density);
    light += through * step * glm::mix(shaded, sunlit, lit), through *= 1.0f - step;
  }
  Cloud cloud{light, 1.0f - through};
  if (cloud.cover > 0.0f) cloud.radiance /= cloud.cover;
  const float near_horizon = glm::smoothstep(0.22f, 0.03f, direction.z);  // lost in the haze
  cloud.radiance = glm::mix(cloud.radiance, horizon_radiance, 0.85f * near_horizon);
  cloud.cover *= glm::smoothstep(0.02f, 0.09f, direction.z);
  return cloud;
}

/// Height (as the sine of the elevation) of hills and of the distant town's roofs, by azimuth.
float skyline(float azimuth, std::uint32_t seed) {
  const float turn = azimuth / (2.0f * glm::pi<float>()) + 0.5f;
  const float roofs =
      0.010f + 0.009f * std::floor(4.0f * noise(glm::vec2(turn * 260.0f, 0.5f), {260, 1}, seed)) / 4.0f;
  return roofs;
}

float hills(float azimuth, std::uint32_t seed) {
  const float turn = azimuth / (2.0f * glm::pi<float>()) + 0.5f;
  return 0.008f + 0.05f * std::pow(fractal_noise(glm::vec2(turn * 7.0f, 0.5f), {7, 1}, 5, seed), 1.5f);
}

/// Fields and woods below, as seen from a few storeys up, paling with the distance.
glm::vec3 ground_radiance(glm::vec3 direction, std::uint32_t seed) {
  const float distance_km = 0.2f / std::max(-direction.z, 1e-3f);
  const glm::vec2 p = 2.5f * distance_km * glm::vec2(direction);
  const glm::ivec2 endless(1 << 20);
  const Cell field = nearest_cell(p, endless, seed);
  const glm::vec3 wood = linear_from_srgb8(0x55, 0x64, 0x3E), grass = linear_from_srgb8(0x86, 0x8C, 0x58);
  const glm::vec3 soil = linear_from_srgb8(0xA8, 0x98, 0x74);
  // Of albedo; sunlit ground radiates 1.6 times it.
  const glm::vec3 colour = field.identity < 0.5f ? glm::mix(wood, grass, 2.0f * field.identity)
                                                 : glm::mix(grass, soil, 2.0f * field.identity - 1.0f);
  const float detail = 0.75f + 0.5f * fractal_noise(4.0f * p, endless, 3, seed + 5);
  const glm::vec3 town = 0.17f * glm::vec3(1.0f, 0.96f, 0.88f);  // underfoot: it lights the place from below
  const float near = glm::smoothstep(-0.15f, -0.45f, direction.z);
  return glm::mix(horizon_radiance, detail * glm::mix(1.6f * colour, town, near),
                  std::exp(-haze_per_km * distance_km));
}

glm::vec3 radiance_from(glm::vec3 direction, glm::vec3 to_sun, std::uint32_t seed) {
  const float azimuth = std::atan2(direction.x, direction.y);
  if (direction.z < 0.0f) return ground_radiance(direction, seed + 30);
  if (direction.z < skyline(azimuth, seed))
    return glm::mix(linear_from_srgb8(0x9C, 0x94, 0x84), horizon_radiance, 0.75f);
  const Cloud cloud = clouds(direction, to_sun, seed + 7);
  const glm::vec3 above = glm::mix(clear_sky(direction, to_sun), cloud.radiance, cloud.cover);
  // Hills rise out of the haze that lies at their feet, and have no hard edge: no band round the horizon.
  const float crest = hills(azimuth, seed + 3);
  const float height = glm::smoothstep(0.0f, 0.05f, direction.z);
  const glm::vec3 slope =
      glm::mix(linear_from_srgb8(0x5E, 0x74, 0x78), horizon_radiance, glm::mix(0.95f, 0.55f, height));
  return glm::mix(above, slope, glm::smoothstep(crest + 0.0015f, crest - 0.0015f, direction.z));
}

}  // namespace

ImageF sky_picture(int width_px, glm::vec3 to_sun, std::uint64_t seed) {
  ImageF picture(width_px, width_px / 2, 3);
  parallel_for(
      std::size_t(picture.height),
      [&](std::size_t row) {
        const float polar = (float(row) + 0.5f) / float(picture.height) * glm::pi<float>();
        for (int x = 0; x < width_px; ++x) {
          const float azimuth = ((float(x) + 0.5f) / float(width_px) - 0.5f) * 2.0f *
                                glm::pi<float>();  // from north, clockwise
          const glm::vec3 direction(std::sin(polar) * std::sin(azimuth), std::sin(polar) * std::cos(azimuth),
                                    std::cos(polar));
          const glm::vec3 radiance = radiance_from(direction, to_sun, std::uint32_t(seed * 2654435761u));
          for (int c = 0; c < 3; ++c) picture.at(x, int(row))[c] = radiance[c];
        }
      },
      8);
  return picture;
}

}  // namespace parvis::synthesis
