// Textures by optimisation, in linear light as they are drawn. A pixel is the over of the billboards' texels
// (equation 4.2), so with T the light that reaches a texel from the eye, its colour takes the share T alpha
// of the pixel's error (simultaneous iterative reconstruction), and its extinction the factor by which the
// room's opacity method would change it (opacity.h): the products of transparency along the pixel then agree
// with the matte. What a photograph does not see keeps the volume's colour.
#include "capture/trees/billboard_textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include "base/colour.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "capture/trees/billboard_math.h"
#include "capture/trees/kept_textures.h"
#include "capture/trees/tree_light.h"

namespace parvis::trees {
namespace {

constexpr float max_alpha_factor = 3.0f;  // of a texel's extinction, per iteration
constexpr float max_alpha = 0.998f;
constexpr int block_side = 4;  // texels; a block of 4x4 becomes 16 bytes
// Share of a billboard's pixels that reach it from the eye, below which it has no texture of its own. A cell
// that the photograph sees to be empty has one: the mean colour in its place would be a halo round the crown.
constexpr float min_seen = 0.02f;

/// Billboards of the cells `levels` above the volume's: the mean colour and extinction of their parts.
BillboardTree bare_billboards(const TreeVolume& volume, int levels) {
  const int branching = volume.grid.branching();
  int step = 1;
  for (int i = 0; i < levels && volume.grid.side() % (step * branching) == 0; ++i) step *= branching;
  std::map<std::array<int, 3>, glm::vec4> parents;  // sums: colour weighed by extinction, extinction
  for (std::size_t i = 0; i < volume.grid.size(); ++i) {
    const glm::ivec3 place = glm::ivec3(volume.grid.cells()[i]) / step;
    const float tau = volume.extinction_per_m[i];
    parents[{place.z, place.y, place.x}] += glm::vec4(volume.colour[i] * tau, tau);
  }
  BillboardTree tree;
  std::vector<glm::u16vec3> cells;
  const int side = volume.grid.side() / step;
  const float chord_m = mean_chord_m(volume.grid.box().size() / float(side));
  for (const auto& [place, sum] : parents) {
    const float alpha = 1.0f - std::exp(-sum.w / float(step * step * step) * chord_m);
    if (alpha < 1.0f / 510.0f) continue;
    cells.emplace_back(place[2], place[1], place[0]);
    tree.base.emplace_back(glm::round(
        255.0f * glm::vec4(srgb_from_linear(glm::clamp(glm::vec3(sum) / sum.w, 0.0f, 1.0f)), alpha)));
  }
  tree.grid = CellGrid(volume.grid.box(), branching, side, std::move(cells));
  return tree;
}

/// Light (straight) and opacity of the volume along a ray within a box.
glm::vec4 seen_within(const TreeVolume& volume, const Bounds& box, const ViewRay& ray) {
  glm::vec3 direction = ray.direction;
  const glm::vec2 span = box_distances(box, ray.origin, inverse_of(direction));
  if (span.x >= span.y) return glm::vec4(0.0f);
  const float inside_m = 1e-4f * (span.y - span.x);
  const ViewRay rest{ray.origin + (span.x + inside_m) * direction, direction};
  const float length_m = span.y - span.x - 2.0f * inside_m;
  glm::vec4 sum(0.0f);
  volume.grid.walk(rest, [&](std::size_t cell, float enter, float leave) {
    if (enter >= length_m) return false;
    const float alpha = 1.0f - std::exp(-volume.extinction_per_m[cell] * (std::min(leave, length_m) - enter));
    sum += (1.0f - sum.w) * alpha * glm::vec4(volume.colour[cell], 1.0f);
    return leave < length_m;
  });
  return sum.w > 0.0f ? glm::vec4(glm::vec3(sum) / sum.w, sum.w) : sum;
}

/// Texels of one photograph while they are fitted.
class Fit {
 public:
  Fit(const BillboardTree& tree, const TreeVolume& volume, const TreeView& view, int side)
      : tree_(tree),
        view_(view),
        photograph_(linear_from_srgb8(view.picture)),
        side_(side),
        per_texture_(std::size_t(side) * std::size_t(side)),
        placed_(placed_billboards(tree.grid, view.camera, false)) {
    texels_.assign(tree.grid.size() * per_texture_, glm::vec4(0.0f));
    colour_.assign(texels_.size(), glm::vec4(0.0f)), opacity_.assign(texels_.size(), glm::vec2(0.0f));
    visible_.assign(tree.grid.size(), 0.0f);
    const glm::vec3 eye = view.camera.position_in_world;
    for (const PlacedBillboard& b : placed_) {
      const glm::vec3 centre = tree.grid.centre(b.cell);
      const BillboardFrame frame = billboard_frame(centre, tree.grid.cell_size_m(), eye);
      const Bounds box = tree.grid.bounds(b.cell);
      const glm::vec3 base = linear_from_srgb(glm::vec3(tree.base[b.cell]) / 255.0f);
      for (int v = 0; v < side; ++v)
        for (int u = 0; u < side; ++u) {
          glm::vec2 place((2.0f * float(u) + 1.0f) / float(side) - 1.0f,
                          1.0f - (2.0f * float(v) + 1.0f) / float(side));
          // Other eyes see what lies beyond this one's silhouette: they get the texture's nearest point.
          place /= std::max(display::silhouette_reach(place, frame.slants) / 0.97f, 1.0f);
          const glm::vec2 m = frame.half_size_m * place;
          const glm::vec3 point = centre + m.x * frame.right + m.y * frame.up;
          glm::vec4 seen = seen_within(volume, box, {eye, glm::normalize(point - eye)});
          if (seen.w <= 0.0f) seen = glm::vec4(base, 0.0f);
          seen.w = std::min(seen.w, max_alpha);
          texels_[b.cell * per_texture_ + std::size_t(v * side + u)] = seen;
        }
    }
  }

  void iterate() {
    render();
    gather();
    for (std::size_t i = 0; i < texels_.size(); ++i) {
      glm::vec4& t = texels_[i];
      const glm::vec4 c = colour_[i];
      if (c.w > 1e-4f) t = glm::vec4(glm::clamp(glm::vec3(t) + glm::vec3(c) / c.w, 0.0f, 1.0f), t.w);
      const glm::vec2 o = opacity_[i];
      if (o.y > 1e-7f) {
        const float factor = std::clamp(o.x / o.y, 1.0f / max_alpha_factor, max_alpha_factor);
        t.w = std::min(1.0f - std::pow(1.0f - t.w, factor), max_alpha);
      }
    }
  }

  BillboardTextures result() const {
    BillboardTextures textures{view_.camera, std::vector<std::int32_t>(tree_.grid.size(), -1), {}};
    std::int32_t next = 0;
    for (const PlacedBillboard& b : placed_) {
      const glm::ivec2 extent = b.high - b.low;
      if (visible_[b.cell] < min_seen * float(extent.x * extent.y)) continue;
      textures.texture_of_cell[b.cell] = next++;
      for (std::size_t k = 0; k < per_texture_; ++k) {
        const glm::vec4 texel = texels_[b.cell * per_texture_ + k];
        const glm::vec4 t = glm::round(255.0f * glm::vec4(srgb_from_linear(glm::vec3(texel)), texel.w));
        for (int c = 0; c < 4; ++c) textures.texels.push_back(std::uint8_t(t[c]));
      }
    }
    return textures;
  }

 private:
  /// A texture at a point: the texels and, premultiplied, the colour.
  glm::vec4 sample(const PlacedBillboard& b, glm::vec2 place, Footprint& footprint) const {
    footprint = Footprint(display::billboard_uv(place), side_);
    glm::vec4 sum(0.0f);
    for (std::size_t k = 0; k < 4; ++k) {
      const glm::vec4 t = texels_[b.cell * per_texture_ + std::size_t(footprint.texel[k])];
      sum += footprint.weight[k] * t.w * glm::vec4(glm::vec3(t), 1.0f);
    }
    return sum;
  }

  void render() {
    picture_.assign(std::size_t(view_.camera.width) * std::size_t(view_.camera.height), glm::vec4(0.0f));
    Footprint footprint({0.0f, 0.0f}, side_);
    for (const PlacedBillboard& b : placed_)
      visit_pixels(b, 0, view_.camera.height, [&](int x, int y, glm::vec2 place) {
        glm::vec4& p = pixel(picture_, x, y);
        if (p.w < 0.9995f) p += (1.0f - p.w) * sample(b, place, footprint);
      });
  }

  /// Gathers each texel's change from the pixels' errors.
  void gather() {
    std::ranges::fill(colour_, glm::vec4(0.0f)), std::ranges::fill(opacity_, glm::vec2(0.0f));
    std::ranges::fill(visible_, 0.0f);
    std::vector<float> passed(picture_.size(), 1.0f);
    Footprint footprint({0.0f, 0.0f}, side_);
    for (const PlacedBillboard& b : placed_)
      visit_pixels(b, 0, view_.camera.height, [&](int x, int y, glm::vec2 place) {
        float& before = pixel(passed, x, y);
        const glm::vec4 found = pixel(picture_, x, y);
        const float* p = photograph_.at(x, y);
        const float alpha = p[3], left = 1.0f - found.w + 1e-3f;
        const glm::vec3 wanted = alpha * glm::vec3(p[0], p[1], p[2]);
        const glm::vec3 residual = wanted - glm::vec3(found);
        const glm::vec4 own = sample(b, place, footprint);
        const std::size_t first = b.cell * per_texture_;
        visible_[b.cell] += before;
        for (std::size_t k = 0; k < 4; ++k) {
          const std::size_t i = first + std::size_t(footprint.texel[k]);
          const float share = before * footprint.weight[k] * texels_[i].w;
          colour_[i] += share * glm::vec4(residual, 1.0f);
          opacity_[i] += footprint.weight[k] * left * glm::vec2(alpha, found.w);
        }
        before *= 1.0f - own.w;
      });
  }

  template <class T>
  T& pixel(std::vector<T>& picture, int x, int y) const {
    return picture[std::size_t(y) * std::size_t(view_.camera.width) + std::size_t(x)];
  }

  const BillboardTree& tree_;
  const TreeView& view_;
  ImageF photograph_;  // straight alpha, linear light
  int side_;
  std::size_t per_texture_;              // texels
  std::vector<PlacedBillboard> placed_;  // front to back
  std::vector<glm::vec4> texels_;        // straight linear light and alpha, side * side per cell
  std::vector<glm::vec4> colour_;        // per texel: sum of share * residual; sum of shares
  std::vector<glm::vec2> opacity_;       // per texel: wanted and found
  std::vector<float> visible_;           // per cell: pixels that reach it
  std::vector<glm::vec4> picture_;       // premultiplied
};

}  // namespace

BillboardTextures optimised_texels(const BillboardTree& tree, const TreeVolume& volume, const TreeView& view,
                                   const TextureOptions& options) {
  Fit fit(tree, volume, view, options.texels_per_side);
  for (int i = 0; i < options.iterations; ++i) fit.iterate();
  return fit.result();
}

namespace {

/// Computes textures by the options' method.
BillboardTextures textures_of(const BillboardTree& tree, const TreeVolume& volume, const TreeView& view,
                              const TextureOptions& options) {
  return options.method == TextureMethod::optimised ? optimised_texels(tree, volume, view, options)
                                                    : selected_texels(tree, view, options);
}

/// The pixels of the photographs that the longer side of a billboard at the grid's middle covers, in the
/// mean.
float pixels_per_billboard(const CellGrid& grid, std::span<const TreeView> views) {
  const glm::vec3 middle = grid.box().centre();
  float sum = 0.0f;
  for (const TreeView& view : views) {
    const glm::vec3 eye = view.camera.position_in_world;
    const glm::vec2 half_m = billboard_frame(middle, grid.cell_size_m(), eye).half_size_m;
    sum += 2.0f * std::max(half_m.x, half_m.y) * view.camera.focal.y / glm::distance(eye, middle);
  }
  return sum / float(std::max(views.size(), std::size_t(1)));
}

/// One photograph stands for all of them: how many cells each sees differs little.
int chosen_texels_per_side(const BillboardTree& tree, const TreeVolume& volume,
                           std::span<const TreeView> views, TextureOptions options) {
  int& side = options.texels_per_side;
  side = block_side * std::clamp(int(std::lround(pixels_per_billboard(tree.grid, views) / block_side)), 1,
                                 max_chosen_side / block_side);
  for (; side > block_side; side -= block_side) {
    const std::size_t bytes = textures_of(tree, volume, views[views.size() / 2], options).texels.size() / 4;
    if (1e-6f * float(bytes) * float(views.size()) <= options.max_megabytes) break;
  }
  return side;
}

}  // namespace

BillboardTree textured(const TreeVolume& volume, std::span<const TreeView> views,
                       const TextureOptions& options) {
  return *textured(volume, views, options, KeptParts());  // what keeps nothing cannot fail
}

Result<BillboardTree> textured(const TreeVolume& volume, std::span<const TreeView> views,
                               const TextureOptions& options, const KeptParts& checkpoint) {
  BillboardTree tree = bare_billboards(volume, options.parent_levels);
  const KeptTextures kept(checkpoint, volume, options);
  TextureOptions chosen = options;
  if (chosen.texels_per_side == 0) {
    const std::optional<int> found = kept.find_side(views);
    chosen.texels_per_side = found ? *found : chosen_texels_per_side(tree, volume, views, options);
    if (!found)
      if (Status status = kept.keep_side(views, chosen.texels_per_side); !status) return status.errors();
  }
  tree.texels_per_side = chosen.texels_per_side;
  tree.views.resize(views.size());
  std::vector<std::size_t> to_do;
  for (std::size_t i = 0; i < views.size(); ++i)
    if (std::optional<BillboardTextures> found = kept.find(i, views[i], tree))
      tree.views[i] = *std::move(found);
    else
      to_do.push_back(i);
  Progress progress("texturing", to_do.size());
  std::vector<Status> statuses(to_do.size(), Ok{});
  parallel_for(to_do.size(), [&](std::size_t k) {
    const std::size_t i = to_do[k];
    tree.views[i] = textures_of(tree, volume, views[i], chosen);
    statuses[k] = kept.keep(i, views[i], tree);
    progress.advance();
  });
  for (const Status& status : statuses)
    if (!status) return status.errors();
  tree.light = estimated_light(tree, options.to_sun);
  return tree;
}

}  // namespace parvis::trees
