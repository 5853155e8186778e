#include "capture/trees/trunk_light.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numeric>

#include "base/colour.h"
#include "base/parallel.h"
#include "capture/trees/tree_light.h"

namespace parvis::trees {
namespace {

constexpr int sides = 16;                 // round the trunk, where light is found; linear between them
constexpr float off_bark = 1.05f;         // radii: before the bark
constexpr float min_light_share = 0.25f;  // of the trunk's mean light: what is darker is not made brighter

/// The light of the photographs for each ring and side, as the brightness of a leaf in it.
std::vector<float> light_on(const Trunk& trunk, const BillboardTree& tree) {
  const CrownShade shade(tree);
  const std::vector<glm::vec3> sky = sky_directions();
  std::vector<float> light(trunk.rings.size() * sides);
  parallel_for(light.size(), [&](std::size_t i) {
    const Trunk::Ring& ring = trunk.rings[i / sides];
    const float angle = glm::two_pi<float>() * float(i % sides) / sides;
    const glm::vec3 normal(std::cos(angle), std::sin(angle), 0.0f);
    const glm::vec3 point = ring.centre + off_bark * ring.radius_m * normal;
    const auto received = [&](glm::vec3 direction) {
      const float cosine = glm::dot(normal, direction);
      return cosine > 0.0f ? cosine * shade.passed(point, direction) : 0.0f;
    };
    float from_sky = 0.0f;
    for (const glm::vec3 direction : sky) from_sky += received(direction);
    // Over a whole open sky above a level surface the mean of the cosines is a half, and its light is all.
    light[i] =
        tree.light.sun * received(tree.light.to_sun) + tree.light.sky * 2.0f * from_sky / float(sky.size());
  });
  return light;
}

}  // namespace

Image8 bark_albedo(const TrunkShape& shape, const BillboardTree& tree) {
  const Trunk& trunk = shape.trunk;
  std::vector<float> light = light_on(trunk, tree);
  const float mean = std::accumulate(light.begin(), light.end(), 0.0f) / float(light.size());
  for (float& value : light) value = std::max(value, std::max(min_light_share * mean, 1e-4f));
  Image8 albedo = shape.bark;
  const float foot = trunk.rings.front().centre.z, height = trunk.rings.back().centre.z - foot;
  for (int y = 0; y < albedo.height; ++y) {
    const float z = foot + height * (1.0f - (float(y) + 0.5f) / float(albedo.height));
    const auto above =
        std::ranges::find_if(trunk.rings, [&](const auto& ring) { return ring.centre.z >= z; });
    const std::size_t upper = std::min(std::size_t(above - trunk.rings.begin()), trunk.rings.size() - 1),
                      lower = upper - std::min<std::size_t>(upper, 1);
    const float low_z = trunk.rings[lower].centre.z, up_z = trunk.rings[upper].centre.z;
    const float share = up_z > low_z ? std::clamp((z - low_z) / (up_z - low_z), 0.0f, 1.0f) : 0.0f;
    for (int x = 0; x < albedo.width; ++x) {
      const float at = float(sides) * (float(x) + 0.5f) / float(albedo.width), f = at - std::floor(at);
      const std::size_t a = std::size_t(at) % sides, b = (a + 1) % sides;
      const auto along = [&](std::size_t ring) {
        return glm::mix(light[ring * sides + a], light[ring * sides + b], f);
      };
      std::uint8_t* texel = albedo.at(x, y);
      const glm::vec3 bark =
          linear_from_srgb(glm::vec3(float(texel[0]), float(texel[1]), float(texel[2])) / 255.0f);
      const glm::vec3 lit = bark * mean_albedo / glm::mix(along(lower), along(upper), share);
      const glm::vec3 srgb = srgb_from_linear(glm::min(lit, glm::vec3(1.0f)));
      for (int c = 0; c < 3; ++c) texel[c] = std::uint8_t(std::lround(255.0f * srgb[c]));
    }
  }
  return albedo;
}

}  // namespace parvis::trees
