#include "capture/trees/leaf_detail.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/random.h"

namespace parvis::trees {
namespace {

namespace detail_math {
using namespace parvis::shading;
#include "capture/trees/leaf_detail.glsl"
}  // namespace detail_math

constexpr int detail_side = LeafDetail::side;
constexpr std::size_t texel_count = std::size_t(detail_side) * detail_side;
constexpr int example_views = 4, example_px = 128;  // how many photographs, and what is taken of each
constexpr int blur_radius = 4;                      // pixels to each side: what is coarser is no detail
constexpr float min_leaf_alpha = 0.3f;              // in the mean there: tree, and not its background
constexpr float min_brightness = 1e-4f;
constexpr float opaque_alpha = 0.9f;  // of leaves before leaves: where contrast is measured
constexpr int patch = 16, patch_step = 8;
constexpr std::size_t min_patches = 16;
constexpr float max_leaf_contrast = 0.35f;  // root of the mean square: beyond it gaps were taken for leaves

float luminance_of(const float* rgba) { return 0.2126f * rgba[0] + 0.7152f * rgba[1] + 0.0722f * rgba[2]; }

/// How each pixel of a photograph differs from the mean around it.
struct Example {
  int width = 0, height = 0;
  std::vector<float> contrast;         // relative
  std::vector<std::uint8_t> is_known;  // it is of the tree
  std::vector<glm::ivec2> patches;     // low corners of those of which all pixels are known
  double squares = 0.0, opaque = 0.0;  // of opaque pixels

  explicit Example(const ImageF& picture) : width(picture.width), height(picture.height) {
    contrast.resize(std::size_t(width) * std::size_t(height)), is_known.resize(contrast.size());
    for (int y = blur_radius; y < height - blur_radius; ++y)
      for (int x = blur_radius; x < width - blur_radius; ++x) measure(picture, x, y);
    for (int y = 0; y + patch <= height; ++y)
      for (int x = 0; x + patch <= width; ++x)
        if (is_whole(x, y)) patches.emplace_back(x, y);
  }
  std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(width) + std::size_t(x); }

 private:
  void measure(const ImageF& picture, int x, int y) {
    float sum = 0.0f, alpha = 0.0f, min = 1.0f;
    for (int v = -blur_radius; v <= blur_radius; ++v)
      for (int u = -blur_radius; u <= blur_radius; ++u) {
        const float* p = picture.at(x + u, y + v);
        sum += luminance_of(p), alpha += p[3], min = std::min(min, p[3]);
      }
    constexpr float count = float((2 * blur_radius + 1) * (2 * blur_radius + 1));
    if (alpha < min_leaf_alpha * count || sum < min_brightness * count) return;
    const float value = luminance_of(picture.at(x, y)) * count / sum - 1.0f;
    contrast[index(x, y)] = value, is_known[index(x, y)] = 1;
    if (min >= opaque_alpha) squares += double(value * value), opaque += 1.0;
  }
  bool is_whole(int left, int top) const {
    for (int y = top; y < top + patch; ++y)
      for (int x = left; x < left + patch; ++x)
        if (!is_known[index(x, y)]) return false;
    return true;
  }
};

/// The middle of what a photograph shows of the tree, at the photograph's resolution.
Pinhole middle_of(Pinhole camera, glm::vec3 middle) {
  const glm::ivec2 size(std::min(camera.width, example_px), std::min(camera.height, example_px));
  const glm::ivec2 seen(glm::round(glm::vec2(camera.project(middle))));
  const glm::ivec2 corner =
      glm::clamp(seen - size / 2, glm::ivec2(0), glm::ivec2(camera.width, camera.height) - size);
  camera.principal_point -= glm::vec2(corner);
  camera.width = size.x, camera.height = size.y;
  return camera;
}

/// Patches at random, blended round each texel.
std::vector<float> blended_patches(const std::vector<Example>& examples, std::size_t patches,
                                   Random& random) {
  std::array<float, patch> window{};
  for (std::size_t i = 0; i < patch; ++i)
    window[i] = 0.5f - 0.5f * std::cos(6.2831853f * (float(i) + 0.5f) / patch);
  std::vector<float> sums(texel_count, 0.0f), squares(texel_count, 0.0f);
  for (int top = 0; top < detail_side; top += patch_step)
    for (int left = 0; left < detail_side; left += patch_step) {
      std::size_t number = std::size_t(random.index(int(patches)));
      auto example = examples.begin();
      while (number >= example->patches.size()) number -= example->patches.size(), ++example;
      const glm::ivec2 from = example->patches[number];
      for (int y = 0; y < patch; ++y)
        for (int x = 0; x < patch; ++x) {
          const std::size_t to =
              std::size_t((top + y) % detail_side) * detail_side + std::size_t((left + x) % detail_side);
          const float weight = window[std::size_t(x)] * window[std::size_t(y)];
          sums[to] += weight * example->contrast[example->index(from.x + x, from.y + y)];
          squares[to] += weight * weight;
        }
    }
  for (std::size_t i = 0; i < texel_count; ++i) sums[i] /= std::sqrt(squares[i]);
  return sums;
}

/// The values by their ranks, spread evenly over -1..1.
std::vector<float> ranked(const std::vector<float>& values) {
  std::vector<std::uint32_t> order(values.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return values[i]; });
  std::vector<float> result(values.size());
  for (std::size_t rank = 0; rank < order.size(); ++rank)
    result[order[rank]] = (2.0f * float(rank) + 1.0f) / float(order.size()) - 1.0f;
  return result;
}

/// `values` without what they have of `other`; both have the mean 0.
void decorrelate(std::vector<float>& values, const std::vector<float>& other) {
  const double common = std::inner_product(values.begin(), values.end(), other.begin(), 0.0);
  const double own = std::inner_product(other.begin(), other.end(), other.begin(), 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= float(common / own) * other[i];
}

}  // namespace

float LeafDetail::width_m() const {
  return photographed_pixel_m * float(detail_side) / detail_math::detail_texels_per_photographed_pixel;
}

glm::vec2 LeafDetail::offset_of(std::size_t cell) {
  Random random(cell, 917);
  const float x = random.uniform();
  return {x, random.uniform()};
}

glm::vec2 LeafDetail::at(glm::vec2 place) const {
  const glm::vec2 texel = float(detail_side) * glm::fract(place) - 0.5f, low = glm::floor(texel),
                  f = texel - low;
  const auto value = [&](int x, int y) {
    return glm::vec2(texels[std::size_t((y + detail_side) % detail_side) * detail_side +
                            std::size_t((x + detail_side) % detail_side)]) /
           127.0f;
  };
  const int x = int(low.x), y = int(low.y);
  return glm::mix(glm::mix(value(x, y), value(x + 1, y), f.x),
                  glm::mix(value(x, y + 1), value(x + 1, y + 1), f.x), f.y);
}

glm::vec4 LeafDetail::added_to(glm::vec4 colour, glm::vec2 place, float pixel_m) const {
  if (is_empty()) return colour;
  const float closer = pixel_m > 0.0f ? photographed_pixel_m / pixel_m : 1e6f;
  const float share = detail_math::detail_share(closer),
              second_share = detail_math::detail_share(closer / detail_math::detail_octave);
  if (share > 0.0f) colour = detail_math::with_detail(colour, share * at(place));
  if (second_share > 0.0f)
    colour = detail_math::with_detail(
        colour, second_share * at(detail_math::detail_octave * place + detail_math::second_detail_offset));
  return colour;
}

LeafDetail leaf_detail(const BillboardTree& tree, std::uint64_t seed) {
  LeafDetail detail;
  if (tree.views.empty() || tree.grid.size() == 0) return detail;
  const glm::vec3 middle = tree.grid.box().centre();
  for (const BillboardTextures& view : tree.views)
    detail.photographed_pixel_m += glm::distance(view.camera.position_in_world, middle) /
                                   (view.camera.focal.y * float(tree.views.size()));
  std::vector<Example> examples;
  const std::size_t count = std::min<std::size_t>(example_views, tree.views.size());
  for (std::size_t i = 0; i < count; ++i)
    examples.emplace_back(
        render_billboards(tree, middle_of(tree.views[i * tree.views.size() / count].camera, middle)));
  std::size_t patches = 0;
  double squares = 0.0, opaque = 0.0;
  for (const Example& example : examples)
    patches += example.patches.size(), squares += example.squares, opaque += example.opaque;
  if (patches < min_patches) return detail;

  Random random(seed, 916);
  const std::vector<float> opacity = ranked(blended_patches(examples, patches, random));
  std::vector<float> brightness = ranked(blended_patches(examples, patches, random));
  decorrelate(brightness, opacity);
  // Of values that are spread evenly over -1..1 the root of the mean square is 1 / sqrt(3).
  const float contrast =
      opaque > 0.0 ? std::min(float(std::sqrt(squares / opaque)), max_leaf_contrast) : 0.0f;
  const float factor = 127.0f * std::min(std::sqrt(3.0f) * contrast, 1.0f);
  for (std::size_t i = 0; i < texel_count; ++i)
    detail.texels.emplace_back(std::lround(127.0f * opacity[i]),
                               std::lround(std::clamp(factor * brightness[i], -127.0f, 127.0f)));
  return detail;
}

}  // namespace parvis::trees
