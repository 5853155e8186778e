#include "scene/data/mip_levels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/colour.h"

namespace parvis::scene {
namespace {

std::uint8_t byte(float value) { return std::uint8_t(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f))); }

Image8 halved(const Image8& fine, bool is_srgb) {
  const ByteTable& colour = values_of_bytes(is_srgb);
  Image8 coarse(std::max(fine.width / 2, 1), std::max(fine.height / 2, 1), 4);
  for (int y = 0; y < coarse.height; ++y)
    for (int x = 0; x < coarse.width; ++x) {
      const int x0 = std::min(2 * x, fine.width - 1), x1 = std::min(2 * x + 1, fine.width - 1);
      const int y0 = std::min(2 * y, fine.height - 1), y1 = std::min(2 * y + 1, fine.height - 1);
      const std::array<const std::uint8_t*, 4> from{fine.at(x0, y0), fine.at(x1, y0), fine.at(x0, y1),
                                                    fine.at(x1, y1)};
      std::uint8_t* to = coarse.at(x, y);
      for (int c = 0; c < 3; ++c) {
        const float mean =
            0.25f * (colour[from[0][c]] + colour[from[1][c]] + colour[from[2][c]] + colour[from[3][c]]);
        to[c] = byte(is_srgb ? srgb_from_linear(mean) : mean);
      }
      to[3] = std::uint8_t((from[0][3] + from[1][3] + from[2][3] + from[3][3] + 2) / 4);
    }
  return coarse;
}

double texels(const Image8& image) { return double(image.width) * double(image.height); }

using Histogram = std::array<std::size_t, 256>;

Histogram alphas(const Image8& image) {
  Histogram counts{};
  for (std::size_t i = 3; i < image.pixels.size(); i += 4) ++counts[image.pixels[i]];
  return counts;
}

std::size_t visible_texels(const Image8& image, int visible) {
  const Histogram counts = alphas(image);
  std::size_t sum = 0;
  for (std::size_t a = std::size_t(visible); a < counts.size(); ++a) sum += counts[a];
  return sum;
}

/// Scales alpha so that about `coverage` of the texels are visible, as nearly as its steps allow, and at
/// least one.
void keep_coverage(Image8& image, double coverage, int visible) {
  const Histogram counts = alphas(image);
  const double wanted = coverage * texels(image);
  double sum = 0.0;  // of the texels at the threshold and above
  int threshold = 256;
  while (threshold > 1) {
    const auto next = sum + double(counts[std::size_t(threshold - 1)]);
    if (sum > 0.0 && next - wanted > wanted - sum) break;
    sum = next, --threshold;
    if (sum >= wanted) break;
  }
  const float scale = float(visible) / float(threshold);
  for (std::size_t i = 3; i < image.pixels.size(); i += 4)
    image.pixels[i] = std::uint8_t(std::min(std::ceil(scale * float(image.pixels[i]) - 1e-4f), 255.0f));
}

}  // namespace

const ByteTable& values_of_bytes(bool is_srgb) {
  static const std::array<ByteTable, 2> tables = [] {
    std::array<ByteTable, 2> both{};
    for (std::size_t i = 0; i < 256; ++i) {
      both[0][i] = float(i) / 255.0f;
      both[1][i] = linear_from_srgb(both[0][i]);
    }
    return both;
  }();
  return tables[is_srgb ? 1 : 0];
}

std::vector<int> visible_alphas(const Model& model) {
  std::vector<int> visible(model.textures.size(), 0);
  for (const Material& m : model.materials) {
    if (m.alpha_mode != Alpha::cutout || m.base_colour_texture == no_index) continue;
    const float cutoff = m.alpha > 0.0f ? m.alpha_cutoff / m.alpha : 1.0f;
    visible[std::size_t(m.base_colour_texture)] =
        std::clamp(int(std::ceil(255.0f * std::min(cutoff, 1.0f) - 1e-3f)), 1, 255);
  }
  return visible;
}

std::vector<Image8> mip_levels(const Texture& texture, int visible_alpha) {
  std::vector<Image8> levels{texture.image};
  while (levels.back().width > 1 || levels.back().height > 1)
    levels.push_back(halved(levels.back(), texture.is_srgb));
  if (visible_alpha == 0) return levels;
  const double coverage = double(visible_texels(levels[0], visible_alpha)) / texels(levels[0]);
  if (coverage <= 0.0 || coverage >= 1.0) return levels;
  for (std::size_t i = 1; i < levels.size(); ++i) keep_coverage(levels[i], coverage, visible_alpha);
  return levels;
}

}  // namespace parvis::scene
