#include "capture/trees/bark_texture.h"

#include <algorithm>
#include <vector>

#include "base/colour.h"
#include "base/parallel.h"

namespace parvis::trees {
namespace {

constexpr int texture_width = 256, texels_per_ring = 8, max_texture_height = 2048;
constexpr int min_wood_alpha = 250;        // of a pixel that shows no background
constexpr float min_cosine = 0.2f;         // between the bark's normal and the direction to a camera
constexpr int grain_scale = 5;             // how much smaller the repeated contrast is
constexpr int mean_radius = 12;            // texels: of the mean that contrast is measured from
constexpr float max_bark_contrast = 0.7f;  // natural logarithm

glm::vec3 linear_of(const std::uint8_t* srgb) {
  return linear_from_srgb(glm::vec3(float(srgb[0]), float(srgb[1]), float(srgb[2])) / 255.0f);
}

/// The wood that a picture shows at a point of it, in pixels: linear light and the fraction of it that is
/// wood, interpolated between four pixels.
glm::vec4 wood_at(const Image8& picture, glm::vec2 point, float leaf_threshold) {
  const glm::vec2 corner = glm::floor(point - 0.5f), share = point - 0.5f - corner;
  glm::vec4 sum(0.0f);
  for (int k = 0; k < 4; ++k) {
    const int dx = k & 1, dy = k >> 1, x = int(corner.x) + dx, y = int(corner.y) + dy;
    if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) continue;
    const std::uint8_t* p = picture.at(x, y);
    const glm::vec3 colour = linear_of(p);
    if (p[3] < min_wood_alpha || log_ratio(colour) > leaf_threshold) continue;
    sum += (dx ? share.x : 1.0f - share.x) * (dy ? share.y : 1.0f - share.y) * glm::vec4(colour, 1.0f);
  }
  return sum;
}

/// The bark's colour at a point from the photographs: linear light; alpha 0 where none sees it.
glm::vec4 bark_at(glm::vec3 point, glm::vec3 normal, std::span<const TreeView> views, float leaf_threshold) {
  glm::vec4 sum(0.0f);
  for (const TreeView& view : views) {
    const float cosine = glm::dot(normal, glm::normalize(view.camera.position_in_world - point));
    if (cosine < min_cosine) continue;
    const glm::vec3 seen = view.camera.project(point);
    if (seen.z <= 0.0f) continue;
    // So that the most direct view dominates without an edge where another takes over.
    sum += std::pow(cosine, 16.0f) * wood_at(view.picture, glm::vec2(seen), leaf_threshold);
  }
  return sum.w > 1e-6f ? glm::vec4(glm::vec3(sum) / sum.w, 1.0f) : glm::vec4(0.0f);
}

/// The logarithm of each texel's light over the mean about it, round the trunk and along it.
std::vector<float> contrast_of(const std::vector<glm::vec4>& texels, int height) {
  std::vector<float> contrast(texels.size(), 0.0f);
  parallel_for(std::size_t(height), [&](std::size_t row) {
    for (int x = 0; x < texture_width; ++x) {
      const glm::vec4& here = texels[row * texture_width + std::size_t(x)];
      if (here.w == 0.0f) continue;
      float sum = 0.0f, count = 0.0f;
      for (int dy = -mean_radius; dy <= mean_radius; ++dy)
        for (int dx = -mean_radius; dx <= mean_radius; ++dx) {
          const int v = std::clamp(int(row) + dy, 0, height - 1),
                    u = (x + dx + texture_width) % texture_width;
          const glm::vec4& there = texels[std::size_t(v) * texture_width + std::size_t(u)];
          sum += there.w * luminance(glm::vec3(there)), count += there.w;
        }
      const float ratio = (luminance(glm::vec3(here)) + 1e-4f) / (sum / count + 1e-4f);
      contrast[row * texture_width + std::size_t(x)] =
          std::clamp(std::log(ratio), -max_bark_contrast, max_bark_contrast);
    }
  });
  return contrast;
}

}  // namespace

Image8 bark_texture(const Trunk& trunk, std::span<const TreeView> views, float leaf_threshold) {
  const int height = std::min(max_texture_height, texels_per_ring * int(trunk.rings.size()));
  Image8 picture(texture_width, height, 4, 255);
  const float low = trunk.rings.front().centre.z, high = trunk.rings.back().centre.z;
  std::vector<glm::vec4> texels(std::size_t(texture_width) * std::size_t(height));
  parallel_for(std::size_t(height), [&](std::size_t row) {
    const Trunk::Ring ring = trunk.ring_at(glm::mix(high, low, (float(row) + 0.5f) / float(height)));
    for (int x = 0; x < texture_width; ++x) {
      const float turn = 6.2831853f * (float(x) + 0.5f) / texture_width;
      const glm::vec3 normal(std::cos(turn), std::sin(turn), 0.0f);
      texels[row * texture_width + std::size_t(x)] =
          bark_at(ring.centre + ring.radius_m * normal, normal, views, leaf_threshold);
    }
  });
  glm::vec4 mean(0.0f);
  for (const glm::vec4& texel : texels) mean += texel;
  const glm::vec3 unseen = mean.w > 0.0f ? glm::vec3(mean) / mean.w : glm::vec3(0.1f);
  const std::vector<float> contrast = contrast_of(texels, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < texture_width; ++x) {
      const glm::vec4& texel = texels[std::size_t(y) * texture_width + std::size_t(x)];
      // The smaller picture goes on mirrored at its ends.
      const int along = grain_scale * y % (2 * height), v = along < height ? along : 2 * height - 1 - along,
                u = grain_scale * x % texture_width;
      const float grain = std::exp(contrast[std::size_t(v) * texture_width + std::size_t(u)]);
      const glm::vec3 srgb =
          srgb_from_linear(glm::min(grain * (texel.w > 0.0f ? glm::vec3(texel) : unseen), glm::vec3(1.0f)));
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = std::uint8_t(std::lround(255.0f * srgb[c]));
    }
  return picture;
}

}  // namespace parvis::trees
