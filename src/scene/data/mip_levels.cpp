#include "scene/data/mip_levels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/colour.h"

namespace parvis::scene {
namespace {

std::uint8_t byte(float value) { return std::uint8_t(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f))); }

/// Bytes of linear values without a power for each: of a value's step of 1/4096 the lowest byte, and the
/// least value of each byte.
struct BytesOfLight {
  static constexpr float steps = 4096.0f;
  std::array<float, 257> least;
  std::array<std::uint8_t, std::size_t(steps) + 1> of_step;

  BytesOfLight() {
    for (std::size_t b = 0; b < least.size(); ++b) {
      std::uint32_t low = 0, high = std::bit_cast<std::uint32_t>(2.0f);  // floats above 0 in their order
      while (low < high) {
        const std::uint32_t middle = (low + high) / 2;
        if (byte(srgb_from_linear(std::bit_cast<float>(middle))) >= b)
          high = middle;
        else
          low = middle + 1;
      }
      least[b] = std::bit_cast<float>(low);
    }
    least[256] = 2.0f;  // no byte
    for (std::size_t i = 0; i < of_step.size(); ++i) of_step[i] = byte(srgb_from_linear(float(i) / steps));
  }

  std::uint8_t operator()(float linear) const {
    std::size_t value = of_step[std::size_t(linear * steps)];
    while (linear >= least[value + 1]) ++value;
    return std::uint8_t(value);
  }
};

template <class ByteOf>
Image8 halved(const Image8& fine, const ByteTable& colour, const ByteOf& byte_of) {
  Image8 coarse;
  coarse.width = std::max(fine.width / 2, 1), coarse.height = std::max(fine.height / 2, 1);
  coarse.channels = 4;
  coarse.pixels.resize(4 * std::size_t(coarse.width) * std::size_t(coarse.height));
  for (int y = 0; y < coarse.height; ++y) {
    const std::uint8_t *above = fine.at(0, std::min(2 * y, fine.height - 1)),
                       *below = fine.at(0, std::min(2 * y + 1, fine.height - 1));
    std::uint8_t* to = coarse.at(0, y);
    for (int x = 0; x < coarse.width; ++x, to += 4) {
      const int left = 4 * std::min(2 * x, fine.width - 1), right = 4 * std::min(2 * x + 1, fine.width - 1);
      const auto bytes = [&](int c) {
        return std::array{above[left + c], above[right + c], below[left + c], below[right + c]};
      };
      for (int c = 0; c < 3; ++c) {
        const std::array<std::uint8_t, 4> of = bytes(c);
        to[c] = byte_of(0.25f * (colour[of[0]] + colour[of[1]] + colour[of[2]] + colour[of[3]]));
      }
      const std::array<std::uint8_t, 4> alpha = bytes(3);
      to[3] = std::uint8_t((alpha[0] + alpha[1] + alpha[2] + alpha[3] + 2) / 4);
    }
  }
  return coarse;
}

Image8 halved(const Image8& fine, bool is_srgb) {
  static const BytesOfLight bytes_of_light;
  const ByteTable& colour = values_of_bytes(is_srgb);
  return is_srgb ? halved(fine, colour, bytes_of_light) : halved(fine, colour, byte);
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

std::vector<Image8> smaller_mip_levels(const Texture& texture, int visible_alpha) {
  std::vector<Image8> levels;
  const Image8* finer = &texture.image;
  while (finer->width > 1 || finer->height > 1) {
    Image8 next = halved(*finer, texture.is_srgb);
    finer = &levels.emplace_back(std::move(next));
  }
  if (visible_alpha == 0) return levels;
  const double coverage = double(visible_texels(texture.image, visible_alpha)) / texels(texture.image);
  if (coverage <= 0.0 || coverage >= 1.0) return levels;
  for (Image8& level : levels) keep_coverage(level, coverage, visible_alpha);
  return levels;
}

}  // namespace parvis::scene
