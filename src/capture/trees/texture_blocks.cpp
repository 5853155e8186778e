// End points by the principal axis of the colours, then one step of least squares over the indices found.
#include "capture/trees/texture_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

namespace parvis::trees {
namespace {

constexpr int axis_steps = 6;  // of the power iteration for the principal axis

std::uint16_t packed565(glm::vec3 c) {
  const glm::ivec3 v(glm::round(glm::clamp(c, 0.0f, 255.0f) * glm::vec3(31.0f, 63.0f, 31.0f) / 255.0f));
  return std::uint16_t(v.x << 11 | v.y << 5 | v.z);
}

glm::vec3 unpacked565(std::uint16_t c) {
  const int r = c >> 11, g = c >> 5 & 63, b = c & 31;
  return {float(r << 3 | r >> 2), float(g << 2 | g >> 4), float(b << 3 | b >> 2)};
}

using Palette = std::array<glm::vec3, 4>;
/// BC3's colours have always four steps.
Palette palette(std::uint16_t first, std::uint16_t second) {
  const glm::vec3 a = unpacked565(first), b = unpacked565(second);
  return {a, b, (2.0f * a + b) / 3.0f, (a + 2.0f * b) / 3.0f};
}

struct Colours {
  std::array<glm::vec3, 16> colour;
  std::array<float, 16> weight;
};

std::uint32_t nearest_indices(const Colours& colours, const Palette& steps) {
  std::uint32_t indices = 0;
  for (std::size_t i = 0; i < 16; ++i) {
    std::uint32_t best = 0;
    float minimum = 1e30f;
    for (std::uint32_t k = 0; k < 4; ++k) {
      const glm::vec3 d = colours.colour[i] - steps[k];
      if (glm::dot(d, d) < minimum) minimum = glm::dot(d, d), best = k;
    }
    indices |= best << (2 * i);
  }
  return indices;
}

/// The ends of the colours' spread along their principal axis.
std::array<glm::vec3, 2> principal_ends(const Colours& colours) {
  glm::vec3 mean(0.0f);
  float total = 1e-6f;
  for (std::size_t i = 0; i < 16; ++i)
    mean += colours.weight[i] * colours.colour[i], total += colours.weight[i];
  mean /= total;
  glm::mat3 covariance(0.0f);
  for (std::size_t i = 0; i < 16; ++i) {
    const glm::vec3 d = colours.colour[i] - mean;
    covariance += colours.weight[i] * glm::outerProduct(d, d);
  }
  glm::vec3 axis(0.58f, 0.6f, 0.55f);
  for (int i = 0; i < axis_steps; ++i) {
    const glm::vec3 next = covariance * axis;
    if (glm::length(next) < 1e-6f) break;
    axis = glm::normalize(next);
  }
  float low = 0.0f, high = 0.0f;
  for (std::size_t i = 0; i < 16; ++i) {
    if (colours.weight[i] < 0.05f) continue;
    const float along = glm::dot(colours.colour[i] - mean, axis);
    low = std::min(low, along), high = std::max(high, along);
  }
  return {mean + high * axis, mean + low * axis};
}

/// The end points that fit the chosen indices best.
std::array<glm::vec3, 2> refined_ends(const Colours& colours, std::uint32_t indices,
                                      std::array<glm::vec3, 2> ends) {
  constexpr std::array<float, 4> share{1.0f, 0.0f, 2.0f / 3.0f, 1.0f / 3.0f};  // of the first end
  float aa = 0.0f, ab = 0.0f, bb = 0.0f;
  glm::vec3 ax(0.0f), bx(0.0f);
  for (std::size_t i = 0; i < 16; ++i) {
    const float a = share[indices >> (2 * i) & 3u], b = 1.0f - a, w = colours.weight[i];
    aa += w * a * a, ab += w * a * b, bb += w * b * b;
    ax += w * a * colours.colour[i], bx += w * b * colours.colour[i];
  }
  const float determinant = aa * bb - ab * ab;
  if (determinant < 1e-4f) return ends;
  return {(bb * ax - ab * bx) / determinant, (aa * bx - ab * ax) / determinant};
}

float squared_error(const Colours& colours, const Palette& steps, std::uint32_t indices) {
  float sum = 0.0f;
  for (std::size_t i = 0; i < 16; ++i) {
    const glm::vec3 d = colours.colour[i] - steps[indices >> (2 * i) & 3u];
    sum += colours.weight[i] * glm::dot(d, d);
  }
  return sum;
}

/// Alphas between the ends, in 8 steps (the first end is the greater).
std::array<std::uint8_t, 8> alpha_steps(int first, int second) {
  std::array<std::uint8_t, 8> steps{std::uint8_t(first), std::uint8_t(second)};
  if (first > second) {
    for (int i = 1; i < 7; ++i)
      steps[std::size_t(i) + 1] = std::uint8_t(((7 - i) * first + i * second + 3) / 7);
  } else {
    for (int i = 1; i < 5; ++i)
      steps[std::size_t(i) + 1] = std::uint8_t(((5 - i) * first + i * second + 2) / 5);
    steps[6] = 0, steps[7] = 255;
  }
  return steps;
}

}  // namespace

TextureBlock compressed_block(const BlockTexels& texels) {
  TextureBlock block{};
  int low = 255, high = 0;
  for (std::size_t i = 0; i < 16; ++i)
    low = std::min(low, int(texels[4 * i + 3])), high = std::max(high, int(texels[4 * i + 3]));
  block[0] = std::uint8_t(high), block[1] = std::uint8_t(low);
  const std::array<std::uint8_t, 8> alphas = alpha_steps(high, low);
  std::uint64_t alpha_indices = 0;
  for (std::size_t i = 0; i < 16; ++i) {
    const auto distance = [&](std::uint8_t step) { return std::abs(int(step) - int(texels[4 * i + 3])); };
    const auto best = std::ranges::min_element(alphas, {}, distance);
    alpha_indices |= std::uint64_t(best - alphas.begin()) << (3 * i);
  }
  for (std::size_t i = 0; i < 6; ++i) block[2 + i] = std::uint8_t(alpha_indices >> (8 * i));

  Colours colours;
  for (std::size_t i = 0; i < 16; ++i) {
    colours.colour[i] = {float(texels[4 * i]), float(texels[4 * i + 1]), float(texels[4 * i + 2])};
    colours.weight[i] = float(texels[4 * i + 3]) / 255.0f;
  }
  std::array<glm::vec3, 2> ends = principal_ends(colours);
  std::array<std::uint16_t, 2> packed{packed565(ends[0]), packed565(ends[1])};
  std::uint32_t indices = nearest_indices(colours, palette(packed[0], packed[1]));
  ends = refined_ends(colours, indices, ends);
  const std::array<std::uint16_t, 2> again{packed565(ends[0]), packed565(ends[1])};
  const std::uint32_t other = nearest_indices(colours, palette(again[0], again[1]));
  if (squared_error(colours, palette(again[0], again[1]), other) <
      squared_error(colours, palette(packed[0], packed[1]), indices))
    packed = again, indices = other;
  for (std::size_t i = 0; i < 2; ++i)
    block[8 + 2 * i] = std::uint8_t(packed[i] & 255), block[9 + 2 * i] = std::uint8_t(packed[i] >> 8);
  for (std::size_t i = 0; i < 4; ++i) block[12 + i] = std::uint8_t(indices >> (8 * i));
  return block;
}

BlockTexels decompressed_block(const TextureBlock& block) {
  BlockTexels texels;
  const std::array<std::uint8_t, 8> alphas = alpha_steps(block[0], block[1]);
  std::uint64_t alpha_indices = 0;
  for (std::size_t i = 0; i < 6; ++i) alpha_indices |= std::uint64_t(block[2 + i]) << (8 * i);
  const Palette steps =
      palette(std::uint16_t(block[8] | block[9] << 8), std::uint16_t(block[10] | block[11] << 8));
  std::uint32_t indices = 0;
  for (std::size_t i = 0; i < 4; ++i) indices |= std::uint32_t(block[12 + i]) << (8 * i);
  for (std::size_t i = 0; i < 16; ++i) {
    const glm::vec3 colour = glm::round(steps[indices >> (2 * i) & 3u]);
    for (int c = 0; c < 3; ++c) texels[4 * i + std::size_t(c)] = std::uint8_t(colour[c]);
    texels[4 * i + 3] = alphas[std::size_t(alpha_indices >> (3 * i) & 7u)];
  }
  return texels;
}

}  // namespace parvis::trees
