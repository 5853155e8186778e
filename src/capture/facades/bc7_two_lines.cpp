// The pattern is chosen by what of the colours' spread does not lie on a line in each part; the few best ones
// are tried out.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "capture/facades/bc7_modes.h"

namespace parvis::facades::bc7 {
namespace {

constexpr std::array<int, 8> weights_of_8{0, 9, 18, 27, 37, 46, 55, 64};
constexpr std::size_t tried_patterns = 4;

/// The format's patterns for two parts: bit i is 1 where texel i belongs to the second.
constexpr std::array<std::uint16_t, 64> patterns{
    0xcccc, 0x8888, 0xeeee, 0xecc8, 0xc880, 0xfeec, 0xfec8, 0xec80, 0xc800, 0xffec, 0xfe80, 0xe800, 0xffe8,
    0xff00, 0xfff0, 0xf000, 0xf710, 0x008e, 0x7100, 0x08ce, 0x008c, 0x7310, 0x3100, 0x8cce, 0x088c, 0x3110,
    0x6666, 0x366c, 0x17e8, 0x0ff0, 0x718e, 0x399c, 0xaaaa, 0xf0f0, 0x5a5a, 0x33cc, 0x3c3c, 0x55aa, 0x9696,
    0xa55a, 0x73ce, 0x13c8, 0x324c, 0x3bdc, 0x6996, 0xc33c, 0x9966, 0x0660, 0x0272, 0x04e4, 0x4e40, 0x2720,
    0xc936, 0x936c, 0x39c6, 0x639c, 0x9336, 0x9cc6, 0x817e, 0xe718, 0xccf0, 0x0fcc, 0x7744, 0xee22};
/// The texel of each pattern's second part whose step is written without its highest bit; in the first part
/// it is texel 0.
constexpr std::array<std::uint8_t, 64> anchors{
    15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 2,  8, 2, 2, 8,
    8,  15, 2,  8,  2,  2,  8,  8,  2,  2,  15, 15, 6,  8,  2,  8,  15, 15, 2, 8, 2, 2,
    2,  15, 15, 6,  6,  2,  6,  8,  15, 15, 2,  2,  15, 15, 15, 15, 15, 2,  2, 15};

using RgbTexels = std::array<glm::vec3, 16>;

std::size_t part_of(std::size_t pattern, std::size_t texel) { return patterns[pattern] >> texel & 1u; }

/// Mean, covariance and principal axis of a part.
struct Spread {
  glm::vec3 sum{0.0f};
  glm::mat3 products{0.0f};
  float count = 0.0f;

  void add(glm::vec3 texel) { sum += texel, products += glm::outerProduct(texel, texel), ++count; }
  glm::vec3 mean() const { return sum / std::max(count, 1.0f); }
  glm::mat3 covariance() const { return products - glm::outerProduct(sum, mean()); }
};

/// Unit axis by power iteration; 0 for a single colour.
glm::vec3 principal_axis(const glm::mat3& covariance) {
  glm::vec3 axis(0.299f, 0.587f, 0.114f);
  for (int round = 0; round < 6; ++round) {
    axis = covariance * axis;
    const float length = glm::length(axis);
    if (length < 1e-6f) return glm::vec3(0.0f);
    axis /= length;
  }
  return axis;
}

/// The squared distances from the part's line, summed.
float off_line(const Spread& spread) {
  const glm::mat3 covariance = spread.covariance();
  const glm::vec3 axis = principal_axis(covariance);
  return std::max(covariance[0][0] + covariance[1][1] + covariance[2][2] - glm::dot(axis, covariance * axis),
                  0.0f);
}

std::array<std::size_t, tried_patterns> best_patterns(const RgbTexels& texels) {
  Spread all;
  for (const glm::vec3& texel : texels) all.add(texel);
  std::array<std::pair<float, std::size_t>, 64> order;
  for (std::size_t p = 0; p < 64; ++p) {
    Spread second, first = all;
    for (std::size_t i = 0; i < 16; ++i)
      if (part_of(p, i) != 0) second.add(texels[i]);
    first.sum -= second.sum, first.products -= second.products, first.count -= second.count;
    order[p] = {off_line(first) + off_line(second), p};
  }
  std::ranges::partial_sort(order, order.begin() + tried_patterns);
  std::array<std::size_t, tried_patterns> best{};
  for (std::size_t k = 0; k < tried_patterns; ++k) best[k] = order[k].second;
  return best;
}

/// The ends of a part's line: 6 bits per channel and one lowest bit that both ends share.
struct Ends {
  glm::ivec3 a{0}, b{0};
  int low = 0;

  static int expanded(int value) { return value << 1 | value >> 6; }  // 7 bits as 8
  glm::ivec4 colour(const glm::ivec3& high) const {
    return {expanded(2 * high.x + low), expanded(2 * high.y + low), expanded(2 * high.z + low), 255};
  }
};

struct Part {
  Ends ends;
  std::array<int, 16> steps{};  ///< of the part's texels
  float error = std::numeric_limits<float>::max();
};

Part with_steps(const RgbTexels& texels, std::size_t pattern, std::size_t which, const Ends& ends) {
  Part part{ends, {}, 0.0f};
  const glm::ivec4 from = ends.colour(ends.a), to = ends.colour(ends.b);
  std::array<glm::vec3, 8> colours;
  for (std::size_t k = 0; k < 8; ++k) colours[k] = glm::vec3(between(from, to, weights_of_8[k]));
  for (std::size_t i = 0; i < 16; ++i) {
    if (part_of(pattern, i) != which) continue;
    float minimum = std::numeric_limits<float>::max();
    for (int k = 0; k < 8; ++k) {
      const glm::vec3 off = texels[i] - colours[std::size_t(k)];
      if (const float error = glm::dot(off, off); error < minimum) minimum = error, part.steps[i] = k;
    }
    part.error += minimum;
  }
  return part;
}

Part best_of(const RgbTexels& texels, std::size_t pattern, std::size_t which, glm::vec3 a, glm::vec3 b) {
  Part best;
  for (int low = 0; low < 2; ++low) {
    const auto rounded = [&](glm::vec3 colour) {
      return glm::clamp(glm::ivec3(glm::round((colour * (127.0f / 255.0f) - float(low)) * 0.5f)), 0, 63);
    };
    const Part one = with_steps(texels, pattern, which, {rounded(a), rounded(b), low});
    if (one.error < best.error) best = one;
  }
  return best;
}

/// The ends that fit best once each texel's step is chosen (least squares).
void refit(const RgbTexels& texels, std::size_t pattern, std::size_t which, const Part& part, glm::vec3& a,
           glm::vec3& b) {
  float aa = 0.0f, ab = 0.0f, bb = 0.0f;
  glm::vec3 sum_a(0.0f), sum_b(0.0f);
  for (std::size_t i = 0; i < 16; ++i) {
    if (part_of(pattern, i) != which) continue;
    const float t = float(weights_of_8[std::size_t(part.steps[i])]) / 64.0f;
    aa += (1 - t) * (1 - t), ab += t * (1 - t), bb += t * t;
    sum_a += (1 - t) * texels[i], sum_b += t * texels[i];
  }
  const float determinant = aa * bb - ab * ab;
  if (std::abs(determinant) < 1e-4f) return;
  a = glm::clamp((bb * sum_a - ab * sum_b) / determinant, 0.0f, 255.0f);
  b = glm::clamp((aa * sum_b - ab * sum_a) / determinant, 0.0f, 255.0f);
}

Part coded_part(const RgbTexels& texels, std::size_t pattern, std::size_t which) {
  Spread spread;
  for (std::size_t i = 0; i < 16; ++i)
    if (part_of(pattern, i) == which) spread.add(texels[i]);
  const glm::vec3 mean = spread.mean(), axis = principal_axis(spread.covariance());
  float minimum = 0.0f, maximum = 0.0f;
  for (std::size_t i = 0; i < 16; ++i)
    if (part_of(pattern, i) == which) {
      const float t = glm::dot(texels[i] - mean, axis);
      minimum = std::min(minimum, t), maximum = std::max(maximum, t);
    }
  glm::vec3 a = mean + minimum * axis, b = mean + maximum * axis;
  Part best = best_of(texels, pattern, which, a, b);
  for (int round = 0; round < refinements; ++round) {
    refit(texels, pattern, which, best, a, b);
    const Part refined = best_of(texels, pattern, which, a, b);
    if (refined.error >= best.error) break;
    best = refined;
  }
  return best;
}

/// The anchor's step is written without its highest bit, which must be 0.
void turn_to_anchor(Part& part, std::size_t pattern, std::size_t which) {
  if (part.steps[which == 0 ? 0 : anchors[pattern]] < 4) return;
  std::swap(part.ends.a, part.ends.b);
  for (int& step : part.steps) step = 7 - step;
}

Bc7Block written(std::size_t pattern, std::array<Part, 2> parts) {
  for (std::size_t which = 0; which < 2; ++which) turn_to_anchor(parts[which], pattern, which);
  Bits bits;
  bits.put(1u << 1, 2), bits.put(unsigned(pattern), 6);
  for (int c = 0; c < 3; ++c)
    for (const Part& part : parts)
      bits.put(unsigned(part.ends.a[c]), 6), bits.put(unsigned(part.ends.b[c]), 6);
  for (const Part& part : parts) bits.put(unsigned(part.ends.low), 1);
  for (std::size_t i = 0; i < 16; ++i)
    bits.put(unsigned(parts[part_of(pattern, i)].steps[i]), i == 0 || i == anchors[pattern] ? 2 : 3);
  return bits.bytes;
}

}  // namespace

Coded two_lines(const BlockTexels& bytes) {
  RgbTexels texels;
  for (std::size_t i = 0; i < 16; ++i) texels[i] = {bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2]};
  Coded best{{}, std::numeric_limits<float>::max()};
  for (const std::size_t pattern : best_patterns(texels)) {
    const std::array<Part, 2> parts{coded_part(texels, pattern, 0), coded_part(texels, pattern, 1)};
    if (const float error = parts[0].error + parts[1].error; error < best.error)
      best = {written(pattern, parts), error};
  }
  return best;
}

BlockTexels texels_of_two_lines(const Bc7Block& block) {
  Bits bits{block, 2};
  const std::size_t pattern = bits.take(6);
  std::array<Ends, 2> ends;
  for (int c = 0; c < 3; ++c)
    for (Ends& part : ends) part.a[c] = int(bits.take(6)), part.b[c] = int(bits.take(6));
  for (Ends& part : ends) part.low = int(bits.take(1));
  BlockTexels texels{};
  for (std::size_t i = 0; i < 16; ++i) {
    const Ends& part = ends[part_of(pattern, i)];
    const int step = int(bits.take(i == 0 || i == anchors[pattern] ? 2 : 3));
    const glm::ivec4 colour =
        between(part.colour(part.a), part.colour(part.b), weights_of_8[std::size_t(step)]);
    for (int c = 0; c < 4; ++c) texels[4 * i + std::size_t(c)] = std::uint8_t(colour[c]);
  }
  return texels;
}

}  // namespace parvis::facades::bc7
