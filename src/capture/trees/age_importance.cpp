// Textures by age and importance (003_d5b01da2d2f805f6, section 4.5.3, with its pseudo-code), and its two
// baselines.
//
// Departures: equation 4.18 has no absolute value and no epsilon, without which texels darker than expected
// come last and equal ones divide by zero. "Replace pixels using texture generation" is the mean of the
// neighbouring pixels that are not used up, as the text says. t_curr is kept at most 1.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/random.h"
#include "capture/trees/billboard_textures.h"

namespace parvis::trees {
namespace {

constexpr float epsilon = 1e-3f;  // of equation 4.18

/// State of a photograph's pixel while pixels are given to cells.
struct PixelState {
  glm::vec3 colour;    ///< sRGB, of the copy C_i
  float alpha;         ///< of the photograph
  float transparency;  ///< t_curr
  int billboards = 0;  ///< N_curr: not yet treated
  int age = 0;
};

/// The mean of the pixels below a texel.
struct TexelState {
  glm::ivec2 low, high;  // pixels
  glm::vec3 colour{0.0f};
  float alpha = 0.0f, age = 0.0f, importance = 0.0f;
};

class Copy {
 public:
  Copy(const TreeView& view, const std::vector<PlacedBillboard>& placed)
      : width_(view.camera.width), height_(view.camera.height) {
    pixels_.resize(std::size_t(width_) * std::size_t(height_));
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      const std::uint8_t* p = view.picture.pixels.data() + 4 * i;
      const float alpha = float(p[3]) / 255.0f;
      pixels_[i] = {glm::vec3(float(p[0]), float(p[1]), float(p[2])) / 255.0f, alpha, 1.0f - alpha};
    }
    for (const PlacedBillboard& b : placed)
      visit_pixels(b, 0, height_, [&](int x, int y, glm::vec2) { ++at(x, y).billboards; });
  }

  PixelState& at(int x, int y) { return pixels_[std::size_t(y) * std::size_t(width_) + std::size_t(x)]; }

  /// The texels of a billboard, resampled from the copy by the area that each covers.
  std::vector<TexelState> texels(const PlacedBillboard& b, int side, float cell_transparency) {
    const glm::mat2 pixels_from_metres = glm::inverse(b.metres_from_pixels);
    std::vector<TexelState> result;
    for (int v = 0; v < side; ++v)
      for (int u = 0; u < side; ++u) {
        const auto corner = [&](int du, int dv) {
          return b.middle +
                 pixels_from_metres * (b.half_size_m * glm::vec2(2.0f * float(u + du) / float(side) - 1.0f,
                                                                 1.0f - 2.0f * float(v + dv) / float(side)));
        };
        const glm::vec2 first = corner(0, 0), second = corner(1, 1);
        TexelState texel;
        texel.low = glm::clamp(glm::ivec2(glm::floor(glm::min(first, second) + 0.5f)), glm::ivec2(0),
                               glm::ivec2(width_ - 1, height_ - 1));
        texel.high = glm::clamp(glm::ivec2(glm::floor(glm::max(first, second) + 0.5f)), texel.low + 1,
                                glm::ivec2(width_, height_));
        float transparency = 0.0f, billboards = 0.0f;
        const float share = 1.0f / float((texel.high.x - texel.low.x) * (texel.high.y - texel.low.y));
        for_pixels(texel, [&](PixelState& p) {
          texel.colour += share * p.colour, texel.alpha += share * p.alpha, texel.age += share * float(p.age);
          transparency += share * p.transparency, billboards += share * float(p.billboards);
        });
        texel.importance =
            1.0f / (std::abs(transparency - std::pow(cell_transparency, billboards)) + epsilon);
        result.push_back(texel);
      }
    return result;
  }

  template <class Visit>
  void for_pixels(const TexelState& texel, Visit&& visit) {
    for (int y = texel.low.y; y < texel.high.y; ++y)
      for (int x = texel.low.x; x < texel.high.x; ++x) visit(at(x, y));
  }

  /// The texel's pixels become the mean of the pixels round it that show the tree.
  void refill(const TexelState& texel) {
    glm::vec3 sum(0.0f);
    float count = 0.0f;
    for (int y = std::max(texel.low.y - 1, 0); y < std::min(texel.high.y + 1, height_); ++y)
      for (int x = std::max(texel.low.x - 1, 0); x < std::min(texel.high.x + 1, width_); ++x) {
        const bool is_inside = x >= texel.low.x && x < texel.high.x && y >= texel.low.y && y < texel.high.y;
        if (!is_inside && at(x, y).alpha > 0.0f) sum += at(x, y).colour, count += 1.0f;
      }
    if (count > 0.0f) for_pixels(texel, [&](PixelState& p) { p.colour = sum / count; });
  }

 private:
  int width_, height_;
  std::vector<PixelState> pixels_;
};

/// Which texels the billboard gets: the first floor(alpha M^2) by age and importance, or at random, or all.
std::vector<std::size_t> selection(const std::vector<TexelState>& texels, float cell_alpha,
                                   const TextureOptions& options, Random& random) {
  std::vector<std::size_t> order(texels.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  if (options.method == TextureMethod::naive) return order;
  if (options.method == TextureMethod::random_texels)
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[std::size_t(random.index(int(i)))]);
  else
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
      return texels[a].age != texels[b].age ? texels[a].age > texels[b].age
                                            : texels[a].importance > texels[b].importance;
    });
  order.resize(std::size_t(std::floor(cell_alpha * float(texels.size()))));
  return order;
}

}  // namespace

BillboardTextures selected_texels(const BillboardTree& tree, const TreeView& view,
                                  const TextureOptions& options) {
  const int side = options.texels_per_side;
  const std::vector<PlacedBillboard> placed = placed_billboards(tree.grid, view.camera, false);
  BillboardTextures textures{view.camera, std::vector<std::int32_t>(tree.grid.size(), -1), {}};
  Copy copy(view, placed);
  Random random(options.seed, 600);
  const bool is_thesis = options.method == TextureMethod::age_importance;
  std::int32_t next = 0;
  for (const PlacedBillboard& b : placed) {
    const float cell_alpha = float(tree.base[b.cell].w) / 255.0f, cell_transparency = 1.0f - cell_alpha;
    const std::vector<TexelState> texels = copy.texels(b, side, cell_transparency);
    std::vector<bool> is_selected(texels.size(), false);
    for (const std::size_t i : selection(texels, cell_alpha, options, random)) is_selected[i] = true;
    textures.texture_of_cell[b.cell] = next++;
    for (std::size_t i = 0; i < texels.size(); ++i) {
      const glm::vec4 rgba =
          glm::round(255.0f * glm::vec4(texels[i].colour, is_selected[i] ? texels[i].alpha : 0.0f));
      for (int c = 0; c < 4; ++c) textures.texels.push_back(std::uint8_t(rgba[c]));
    }
    if (!is_thesis) continue;
    for (std::size_t i = 0; i < texels.size(); ++i) {
      if (is_selected[i]) {
        copy.for_pixels(texels[i], [&](PixelState& p) {
          p.transparency = std::min(1.0f, p.transparency / std::max(cell_transparency, epsilon));
        });
        copy.refill(texels[i]);
      } else {
        copy.for_pixels(texels[i], [](PixelState& p) { ++p.age; });
      }
    }
    visit_pixels(b, 0, view.camera.height, [&](int x, int y, glm::vec2) { --copy.at(x, y).billboards; });
  }
  return textures;
}

}  // namespace parvis::trees
