#include <algorithm>
#include <cmath>
#include <limits>

#include "capture/facades/bc7_modes.h"

namespace parvis::facades::bc7 {
namespace {

constexpr std::array<int, 16> weights_of_16{0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};

/// An endpoint: 7 bits per channel and one lowest bit that all channels share.
struct Endpoint {
  glm::ivec4 high{0};
  int low = 0;

  glm::ivec4 value() const { return 2 * high + low; }
};
Endpoint rounded(const glm::vec4& colour, int low) {
  return {glm::clamp(glm::ivec4(glm::round((colour - float(low)) * 0.5f)), 0, 127), low};
}

glm::ivec4 at_step(const glm::ivec4& a, const glm::ivec4& b, int step) {
  return between(a, b, weights_of_16[std::size_t(step)]);
}

using RgbaTexels = std::array<glm::vec4, 16>;
using Steps = std::array<int, 16>;

struct Candidate {
  Endpoint a, b;
  Steps steps{};
  float error = 0.0f;
};

/// Each texel's nearest step between two endpoints.
Candidate with_steps(const RgbaTexels& texels, const Endpoint& a, const Endpoint& b) {
  Candidate result{a, b, {}, 0.0f};
  const glm::vec4 from(a.value()), along = glm::vec4(b.value()) - from;
  const float length2 = std::max(glm::dot(along, along), 1e-6f);
  for (std::size_t i = 0; i < 16; ++i) {
    const float t = glm::dot(texels[i] - from, along) / length2;
    const int guess = std::clamp(int(std::lround(15.0f * t)), 0, 15);
    float minimum = std::numeric_limits<float>::max();
    for (int step = std::max(guess - 1, 0); step <= std::min(guess + 1, 15); ++step) {
      const glm::vec4 off = texels[i] - glm::vec4(at_step(a.value(), b.value(), step));
      if (const float error = glm::dot(off, off); error < minimum) minimum = error, result.steps[i] = step;
    }
    result.error += minimum;
  }
  return result;
}

/// The best of the four choices of lowest bits.
Candidate best_of(const RgbaTexels& texels, const glm::vec4& a, const glm::vec4& b) {
  Candidate best;
  best.error = std::numeric_limits<float>::max();
  for (int low = 0; low < 4; ++low)
    if (const Candidate one = with_steps(texels, rounded(a, low & 1), rounded(b, low >> 1));
        one.error < best.error)
      best = one;
  return best;
}

/// Ends of the texels along their principal axis, by power iteration.
void principal_ends(const RgbaTexels& texels, glm::vec4& a, glm::vec4& b) {
  glm::vec4 mean(0.0f), low = texels[0], high = texels[0];
  for (const glm::vec4& texel : texels)
    mean += texel / 16.0f, low = glm::min(low, texel), high = glm::max(high, texel);
  glm::mat4 covariance(0.0f);
  for (const glm::vec4& texel : texels) covariance += glm::outerProduct(texel - mean, texel - mean);
  glm::vec4 axis = high - low;
  for (int round = 0; round < 6; ++round) {
    axis = covariance * axis;
    const float length = glm::length(axis);
    if (length < 1e-6f) break;
    axis /= length;
  }
  if (glm::dot(axis, axis) < 1e-6f) {
    a = b = mean;
    return;
  }
  axis = glm::normalize(axis);
  float minimum = 0.0f, maximum = 0.0f;
  for (const glm::vec4& texel : texels) {
    const float t = glm::dot(texel - mean, axis);
    minimum = std::min(minimum, t), maximum = std::max(maximum, t);
  }
  a = mean + minimum * axis, b = mean + maximum * axis;
}

/// The endpoints that fit best once each texel's step is chosen.
void refit(const RgbaTexels& texels, const Steps& steps, glm::vec4& a, glm::vec4& b) {
  float aa = 0.0f, ab = 0.0f, bb = 0.0f;
  glm::vec4 sum_a(0.0f), sum_b(0.0f);
  for (std::size_t i = 0; i < 16; ++i) {
    const float t = float(weights_of_16[std::size_t(steps[i])]) / 64.0f;
    aa += (1 - t) * (1 - t), ab += t * (1 - t), bb += t * t;
    sum_a += (1 - t) * texels[i], sum_b += t * texels[i];
  }
  const float determinant = aa * bb - ab * ab;
  if (std::abs(determinant) < 1e-4f) return;
  a = glm::clamp((bb * sum_a - ab * sum_b) / determinant, 0.0f, 255.0f);
  b = glm::clamp((aa * sum_b - ab * sum_a) / determinant, 0.0f, 255.0f);
}

Bc7Block written(Candidate block) {
  // The first step is written without its highest bit, which must be 0.
  if (block.steps[0] > 7) {
    std::swap(block.a, block.b);
    for (int& step : block.steps) step = 15 - step;
  }
  Bits bits;
  bits.put(1u << 6, 7);
  for (int c = 0; c < 4; ++c) bits.put(unsigned(block.a.high[c]), 7), bits.put(unsigned(block.b.high[c]), 7);
  bits.put(unsigned(block.a.low), 1), bits.put(unsigned(block.b.low), 1);
  for (std::size_t i = 0; i < 16; ++i) bits.put(unsigned(block.steps[i]), i == 0 ? 3 : 4);
  return bits.bytes;
}

}  // namespace

Coded one_line(const BlockTexels& bytes) {
  RgbaTexels texels;
  for (std::size_t i = 0; i < 16; ++i)
    texels[i] = {bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2], bytes[4 * i + 3]};
  glm::vec4 a, b;
  principal_ends(texels, a, b);
  Candidate best = best_of(texels, a, b);
  for (int round = 0; round < refinements; ++round) {
    refit(texels, best.steps, a, b);
    const Candidate refined = best_of(texels, a, b);
    if (refined.error >= best.error) break;
    best = refined;
  }
  return {written(best), best.error};
}

BlockTexels texels_of_one_line(const Bc7Block& block) {
  BlockTexels texels{};
  Bits bits{block, 0};
  bits.take(7);  // the mode
  Endpoint a, b;
  for (int c = 0; c < 4; ++c) a.high[c] = int(bits.take(7)), b.high[c] = int(bits.take(7));
  a.low = int(bits.take(1)), b.low = int(bits.take(1));
  for (std::size_t i = 0; i < 16; ++i) {
    const glm::ivec4 colour = at_step(a.value(), b.value(), int(bits.take(i == 0 ? 3 : 4)));
    for (int c = 0; c < 4; ++c) texels[4 * i + std::size_t(c)] = std::uint8_t(colour[c]);
  }
  return texels;
}

}  // namespace parvis::facades::bc7
