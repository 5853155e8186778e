// Departure from 3.6.1: a layer's texture is not one rectangle with a sheared frustum but the tiles of it
// that are needed; texels stay the photograph's own, and the frustum's matrix is the photograph's with the
// tile's place added.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "base/parallel.h"
#include "capture/facades/packed_facade.h"

namespace parvis::facades {
namespace {

constexpr double outline_margin = 0.01;  ///< of the picture's width: how exact outlines before a backdrop are
constexpr int dilation_rings = 6;  ///< pixels beyond a surface's edge that repeat it: filters and mipmaps
/// Of pixels that were filled, in mixed tiles.
constexpr std::uint8_t unseen_alpha = 191;
constexpr std::size_t max_known_colours = 2000;  ///< that unknown surfaces are coloured from

/// A layer as it is stored, with what is needed of it.
struct LayerPicture {
  Image8 rgba;                   ///< of the box; alpha: seen or an artist's
  std::vector<char> is_covered;  ///< by a surface, dilated
  std::vector<char> is_needed;
  std::vector<char> is_own;  ///< by a surface: what other layers of the tile may not have
  bool has_alpha = false;
  bool holds_backdrop = false;
};

std::size_t at(const PixelBox& box, int x, int y) {
  return std::size_t(y) * std::size_t(box.width) + std::size_t(x);
}

/// Uncovered pixels next to covered ones take their mean, ring by ring.
void dilate(LayerPicture& picture) {
  const int width = picture.rgba.width, height = picture.rgba.height;
  const PixelBox box{0, 0, width, height};
  std::vector<int> rim;
  for (int ring = 0; ring < dilation_rings; ++ring) {
    const std::vector<char> before = picture.is_covered;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        if (before[at(box, x, y)]) continue;
        std::array<int, 4> sum{};
        int count = 0;
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
          for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
            if (before[at(box, u, v)]) {
              for (std::size_t c = 0; c < 4; ++c) sum[c] += picture.rgba.at(u, v)[c];
              ++count;
            }
        if (count == 0) continue;
        for (std::size_t c = 0; c < 4; ++c)
          picture.rgba.at(x, y)[c] = std::uint8_t((sum[c] + count / 2) / count);
        picture.is_covered[at(box, x, y)] = 1;
      }
  }
}

/// What lies behind other surfaces, of the backdrop, is in no layer but may be looked up: alpha 0 says that
/// nothing is known.
void hide_rest(LayerPicture& picture) {
  for (std::size_t i = 0; i < picture.is_own.size(); ++i)
    if (!picture.is_own[i]) picture.rgba.pixels[4 * i + 3] = 0, picture.is_own[i] = picture.is_covered[i] = 1;
}

/// The box with its left and top edges moved out to the photograph's grid of tiles, so that layers may share
/// tiles.
PixelBox on_tile_grid(const PixelBox& box) {
  const int x = box.x / tile_inner * tile_inner, y = box.y / tile_inner * tile_inner;
  return {x, y, box.x + box.width - x, box.y + box.height - y};
}

/// Per layer and pixel of its box: 1 where the layer has to be stored because this photograph shows it, or
/// because no photograph does and this one has the finest pixels of it.
using NeededPixels = std::vector<Image8>;

bool holds_backdrop(const PlaceLayers& place, std::size_t photo, std::size_t layer) {
  return std::ranges::any_of(place.layered[photo].layers[layer].items, [&](std::uint32_t item) {
    return place.model.objects[place.visibility[photo].items[item].object].is_backdrop;
  });
}

LayerPicture layer_picture(const PlaceLayers& place, std::size_t photo, std::size_t l, const Image8& needed,
                           const std::vector<std::uint32_t>& layer_of_pixel) {
  const PixelBox &box = place.layered[photo].layers[l].box, grid = on_tile_grid(box);
  const Filled& filled = place.filled[photo];
  LayerPicture picture{Image8(grid.width, grid.height, 4),
                       std::vector<char>(std::size_t(grid.width) * std::size_t(grid.height), 0),
                       {},
                       {},
                       false};
  picture.is_needed = picture.is_covered;
  const int left = box.x - grid.x, top = box.y - grid.y;
  for (int y = 0; y < box.height; ++y)
    for (int x = 0; x < box.width; ++x) {
      if (!place.layered[photo].masks[l].at(x, y)[0]) continue;
      const FillSource source = FillSource(*filled.sources[l].at(x, y));
      const bool is_first = layer_of_pixel[std::size_t(y + box.y) * std::size_t(place.views[photo].width) +
                                           std::size_t(x + box.x)] == l;
      const bool is_certain = source == FillSource::seen || source == FillSource::painted;
      const bool takes_proposal = source == FillSource::painted || filled.states[l] == Filling::accepted ||
                                  (filled.states[l] == Filling::proposal && !is_first);
      const Image8& from = takes_proposal ? filled.pixels[l] : place.originals[photo][l];
      std::uint8_t* p = picture.rgba.at(x + left, y + top);
      std::copy_n(from.at(x, y), 4, p);
      if (source == FillSource::painted && p[3] < 255) picture.has_alpha = true;
      if (source != FillSource::painted) p[3] = is_certain ? 255 : unseen_alpha;
      picture.is_covered[at(grid, x + left, y + top)] = 1;
      picture.is_needed[at(grid, x + left, y + top)] = is_first || *needed.at(x, y) != 0;
    }
  // Alpha then is the artist's alone.
  if (picture.has_alpha)
    for (int y = 0; y < box.height; ++y)
      for (int x = 0; x < box.width; ++x)
        if (*filled.sources[l].at(x, y) != std::uint8_t(FillSource::painted))
          picture.rgba.at(x + left, y + top)[3] = 255;
  picture.is_own = picture.is_covered;
  dilate(picture);
  picture.holds_backdrop = holds_backdrop(place, photo, l);
  if (picture.holds_backdrop) hide_rest(picture);
  return picture;
}

/// A slot's texels while layers are put into it.
struct OpenSlot {
  Image8 texels{tile_side, tile_side, 4};
  std::vector<char> is_own = std::vector<char>(std::size_t(tile_side) * tile_side, 0), is_covered = is_own;
  glm::ivec2 cell{0};  ///< of the photograph's grid of tiles
  bool has_artists_alpha = false;

  /// Adds a layer's tile, unless they want the same texel.
  bool take(const OpenSlot& other) {
    for (std::size_t i = 0; i < is_own.size(); ++i)
      if (is_own[i] && other.is_own[i]) return false;
    for (std::size_t i = 0; i < is_own.size(); ++i) {
      if (!other.is_covered[i] || is_own[i] || (is_covered[i] && !other.is_own[i])) continue;
      std::copy_n(other.texels.pixels.data() + 4 * i, 4, texels.pixels.data() + 4 * i);
      is_covered[i] = 1, is_own[i] = other.is_own[i];
    }
    return true;
  }
};

OpenSlot tile_of(const LayerPicture& picture, int column, int row) {
  const PixelBox box{0, 0, picture.rgba.width, picture.rgba.height};
  OpenSlot tile;
  for (int y = 0; y < tile_side; ++y)
    for (int x = 0; x < tile_side; ++x) {
      const int u = column * tile_inner + x - tile_border, v = row * tile_inner + y - tile_border;
      const int px = std::clamp(u, 0, box.width - 1), py = std::clamp(v, 0, box.height - 1);
      const std::size_t i = std::size_t(y * tile_side + x);
      if (picture.holds_backdrop &&
          (u != px || v != py)) {  // beyond the box: known as little as behind surfaces
        tile.texels.at(x, y)[3] = 0, tile.is_covered[i] = tile.is_own[i] = 1;
        continue;
      }
      if (std::abs(u - px) > dilation_rings || std::abs(v - py) > dilation_rings) continue;
      if (!picture.is_covered[at(box, px, py)]) continue;
      std::copy_n(picture.rgba.at(px, py), 4, tile.texels.at(x, y));
      tile.is_covered[i] = 1;
      tile.is_own[i] = u == px && v == py && picture.is_own[at(box, px, py)];
    }
  return tile;
}

/// Texels far from any surface take the mean colour, which compresses best. Where all that is known was seen,
/// alpha is 255 throughout: then it costs no precision.
void complete(OpenSlot& slot) {
  std::array<long, 4> sum{};
  long count = 0;
  bool is_opaque = true;
  for (std::size_t i = 0; i < slot.is_covered.size(); ++i)
    if (slot.is_covered[i]) {
      for (std::size_t c = 0; c < 4; ++c) sum[c] += slot.texels.pixels[4 * i + c];
      is_opaque &= !slot.is_own[i] || slot.texels.pixels[4 * i + 3] == 255;
      ++count;
    }
  for (std::size_t i = 0; i < slot.is_covered.size(); ++i) {
    if (!slot.is_covered[i] && count > 0)
      for (std::size_t c = 0; c < 4; ++c) slot.texels.pixels[4 * i + c] = std::uint8_t(sum[c] / count);
    if (is_opaque) slot.texels.pixels[4 * i + 3] = 255;
  }
}

/// Whether a texel was seen is kept per block: colours then need not share a block's line with alpha, which
/// would cost them most of their precision. Blocks that hold what is not known, or an artist's alpha, stay.
void decide_blocks(Image8& texels) {
  for (int top = 0; top < texels.height; top += 4)
    for (int left = 0; left < texels.width; left += 4) {
      int minimum = 255, sum = 0;
      for (int i = 0; i < 16; ++i) {
        const int alpha = texels.at(left + i % 4, top + i / 4)[3];
        minimum = std::min(minimum, alpha), sum += alpha;
      }
      if (minimum < unseen_alpha || minimum == 255) continue;
      const std::uint8_t alpha = 2 * sum >= 16 * (255 + unseen_alpha) ? 255 : unseen_alpha;
      for (int i = 0; i < 16; ++i) texels.at(left + i % 4, top + i / 4)[3] = alpha;
    }
}

Image8 halved(const Image8& image) {
  Image8 half(image.width / 2, image.height / 2, 4);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      for (int c = 0; c < 4; ++c)
        half.at(x, y)[c] =
            std::uint8_t((image.at(2 * x, 2 * y)[c] + image.at(2 * x + 1, 2 * y)[c] +
                          image.at(2 * x, 2 * y + 1)[c] + image.at(2 * x + 1, 2 * y + 1)[c] + 2) /
                         4);
  return half;
}

/// Is anything of the tile needed, and what does its alpha say?
TileKind kind_of(const LayerPicture& picture, int column, int row) {
  const PixelBox box{0, 0, picture.rgba.width, picture.rgba.height};
  bool is_needed = false, is_all_seen = true;
  for (int y = row * tile_inner; y < std::min((row + 1) * tile_inner, box.height); ++y)
    for (int x = column * tile_inner; x < std::min((column + 1) * tile_inner, box.width); ++x) {
      if (!picture.is_covered[at(box, x, y)]) continue;
      is_needed |= picture.is_needed[at(box, x, y)] != 0;
      is_all_seen &= picture.rgba.at(x, y)[3] == 255;
    }
  if (!is_needed) return TileKind::none;
  return is_all_seen ? TileKind::seen : picture.has_alpha ? TileKind::alpha : TileKind::mixed;
}

std::vector<Bc7Block> blocks_of(OpenSlot& slot) {
  complete(slot);
  std::vector<Bc7Block> blocks;
  for (int level = 0; level < tile_levels; ++level) {
    if (!slot.has_artists_alpha) decide_blocks(slot.texels);
    std::ranges::copy(bc7_blocks(slot.texels), std::back_inserter(blocks));
    slot.texels = halved(slot.texels);
  }
  return blocks;
}

/// The needed tiles of a photograph's layers; layers that do not overlap share them.
class PhotoTiles {
 public:
  /// Adds a layer's tiles to `facade`, whose slots so far are `first_slot`.
  void add(const LayerPicture& picture, const PackedLayer& layer, std::size_t first_slot,
           PackedFacade& facade) {
    for (int row = 0; row < layer.down(); ++row)
      for (int column = 0; column < layer.across(); ++column) {
        const TileKind kind = kind_of(picture, column, row);
        std::uint32_t entry = std::uint32_t(kind);
        if (kind != TileKind::none) {
          OpenSlot tile = tile_of(picture, column, row);
          tile.has_artists_alpha = kind == TileKind::alpha;
          tile.cell = glm::ivec2(layer.box.x / tile_inner + column, layer.box.y / tile_inner + row);
          entry |= std::uint32_t(first_slot + place(std::move(tile), kind)) << 2;
        }
        facade.tiles.push_back(entry);
      }
  }
  std::vector<OpenSlot>& slots() { return slots_; }

 private:
  /// An artist's alpha belongs to one layer alone.
  std::size_t place(OpenSlot tile, TileKind kind) {
    std::vector<std::size_t>& here = slots_of_cell_[{tile.cell.x, tile.cell.y}];
    if (kind != TileKind::alpha)
      for (const std::size_t slot : here)
        if (slots_[slot].take(tile)) return slot;
    if (kind != TileKind::alpha) here.push_back(slots_.size());
    slots_.push_back(std::move(tile));
    return slots_.size() - 1;
  }

  std::vector<OpenSlot> slots_;
  std::map<std::pair<int, int>, std::vector<std::size_t>> slots_of_cell_;
};

/// Does this photograph have the finest pixels of a point that none shows?
bool is_finest(const PlaceLayers& place, const std::vector<std::vector<std::uint32_t>>& items,
               std::size_t photo, std::uint32_t triangle, glm::dvec3 point, double pixel_size) {
  for (std::size_t i = 0; i < place.views.size(); ++i) {
    if (i == photo || items[i][triangle] == no_item) continue;
    const View& view = place.views[i];
    const glm::dvec3 p = view.to_camera(point);
    if (p.z <= 0.0) continue;
    const glm::dvec2 pixel = view.to_pixel(p);
    if (pixel.x < 1.0 || pixel.y < 1.0 || pixel.x > view.width - 1.0 || pixel.y > view.height - 1.0) continue;
    const double other = p.z / view.fx;
    if (other < pixel_size || (other == pixel_size && i < photo)) return false;
  }
  return true;
}

NeededPixels needed_pixels(const PlaceLayers& place, const std::vector<std::vector<std::uint32_t>>& items,
                           std::size_t photo) {
  const LayeredView& layered = place.layered[photo];
  const View& view = place.views[photo];
  NeededPixels needed;
  for (const ImageLayer& layer : layered.layers) needed.emplace_back(layer.box.width, layer.box.height, 1);
  visit_stacks(place.model, view, false, {}, [&](int x, int y, std::span<const Fragment> stack) {
    for (const Fragment& fragment : stack) {
      const std::uint32_t item = items[photo][fragment.triangle];
      if (item == no_item || !has_layer_pixel(place.model, fragment, stack)) continue;
      const std::uint32_t l = layered.layer_of_item[item];
      const PixelBox& box = layered.layers[l].box;
      const FillSource source = FillSource(*place.filled[photo].sources[l].at(x - box.x, y - box.y));
      const bool is_guess = source == FillSource::patches || source == FillSource::smooth;
      const bool is_wanted = source == FillSource::painted ||
                             (is_guess && is_finest(place, items, photo, fragment.triangle,
                                                    view.to_world({x + 0.5, y + 0.5}, fragment.depth),
                                                    fragment.depth / view.fx));
      if (is_wanted) *needed[l].at(x - box.x, y - box.y) = 1;
    }
  });
  return needed;
}

/// Each pixel's layer: of the surface that is nearest.
std::vector<std::uint32_t> layers_of_pixels(const PlaceLayers& place, std::size_t photo,
                                            const ItemBuffer& seen) {
  std::vector<std::uint32_t> layer_of_triangle;
  for (const std::uint32_t item : item_of_triangle(place.model, place.visibility[photo].items))
    layer_of_triangle.push_back(item == no_item ? no_item : place.layered[photo].layer_of_item[item]);
  std::vector<std::uint32_t> layers(seen.triangles.size(), no_item);
  for (std::size_t i = 0; i < layers.size(); ++i)
    if (seen.triangles[i] != no_triangle_seen) layers[i] = layer_of_triangle[seen.triangles[i]];
  return layers;
}

/// Mean colours of triangles, balanced sRGB.
struct TriangleColours {
  std::vector<glm::dvec3> sums;
  std::vector<double> counts;
};

void add_colours(const PlaceLayers& place, std::size_t photo, const ItemBuffer& seen,
                 const std::vector<std::uint32_t>& layers, TriangleColours& colours) {
  const Balance& balance = place.balances[photo];
  for (int y = 0; y < seen.height; y += 2)
    for (int x = 0; x < seen.width; x += 2) {
      const std::uint32_t triangle = seen.triangles[seen.index(x, y)], layer = layers[seen.index(x, y)];
      if (layer == no_item) continue;
      const PixelBox& box = place.layered[photo].layers[layer].box;
      if (*place.filled[photo].sources[layer].at(x - box.x, y - box.y) != std::uint8_t(FillSource::seen))
        continue;
      const std::uint8_t* p = place.originals[photo][layer].at(x - box.x, y - box.y);
      for (int c = 0; c < 3; ++c)
        colours.sums[triangle][c] +=
            balance.scale[std::size_t(c)] * p[c] + 255.0 * balance.offset[std::size_t(c)];
      ++colours.counts[triangle];
    }
}

/// Mean of the nearest known colours, weighted by distance.
class NearestColours {
 public:
  /// Of those triangles that `counts` holds for.
  template <class Counts>
  NearestColours(const LayerModel& model, const TriangleColours& colours, Counts&& counts) {
    std::vector<std::size_t> known;
    for (std::size_t t = 0; t < colours.counts.size(); ++t)
      if (colours.counts[t] > 0.0 && counts(model.triangles[t])) known.push_back(t);
    const std::size_t stride = known.size() / max_known_colours + 1;
    for (std::size_t i = 0; i < known.size(); i += stride) {
      const auto& c = model.triangles[known[i]].corners;
      points_.push_back((c[0] + c[1] + c[2]) / 3.0);
      colours_.push_back(colours.sums[known[i]] / colours.counts[known[i]]);
    }
  }
  bool empty() const { return points_.empty(); }
  glm::u8vec3 at(glm::dvec3 point) const {
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const glm::dvec3 off = points_[i] - point;
      const double d2 = glm::dot(off, off) + 1e-6, weight = 1.0 / (d2 * d2);
      sum += weight * colours_[i], weights += weight;
    }
    if (weights <= 0.0) return glm::u8vec3(128);
    return glm::u8vec3(glm::clamp(glm::round(sum / weights), 0.0, 255.0));
  }

 private:
  std::vector<glm::dvec3> points_, colours_;
};

/// The model's triangles, those of a surface together.
std::vector<std::uint32_t> by_surface(const LayerModel& model) {
  std::vector<std::uint32_t> order(model.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t t) { return model.triangles[t].object; });
  return order;
}

void add_surfaces(const PlaceLayers& place, const TriangleColours& colours, PackedFacade& facade) {
  for (const LayerObject& object : place.model.objects) facade.surfaces.push_back(object.name);
  // A surface goes on as it is elsewhere: the lawn green, the sky bright; one that is nowhere seen as the
  // place.
  const NearestColours of_place(place.model, colours, [](const LayerTriangle&) { return true; });
  std::vector<NearestColours> of_surface;
  for (std::uint32_t object = 0; object < place.model.objects.size(); ++object)
    of_surface.emplace_back(place.model, colours,
                            [&](const LayerTriangle& triangle) { return triangle.object == object; });
  const std::vector<std::uint32_t> order = by_surface(place.model);
  facade.corners.resize(3 * order.size()), facade.fallback.resize(3 * order.size());
  facade.surface_of_triangle.resize(order.size());
  parallel_for(
      order.size(),
      [&](std::size_t i) {
        const LayerTriangle& triangle = place.model.triangles[order[i]];
        facade.surface_of_triangle[i] = triangle.object;
        const NearestColours& own = of_surface[triangle.object];
        const NearestColours& nearest = own.empty() ? of_place : own;
        for (std::size_t k = 0; k < 3; ++k) {
          facade.corners[3 * i + k] = glm::vec3(triangle.corners[k]);
          facade.fallback[3 * i + k] = nearest.at(triangle.corners[k]);
        }
      },
      64);
}

/// Per pixel: shows the backdrop, more than `margin` pixels away from what lies before it, by chessboard
/// steps in two passes (Rosenfeld and Pfaltz 1966).
std::vector<char> open_backdrop(const LayerModel& model, const ItemBuffer& seen, int margin) {
  const PixelBox box{0, 0, seen.width, seen.height};
  std::vector<int> distance(seen.triangles.size(), 0);
  for (std::size_t i = 0; i < distance.size(); ++i)
    if (const std::uint32_t t = seen.triangles[i]; t != no_triangle_seen)
      distance[i] = model.objects[model.triangles[t].object].is_backdrop ? margin + 1 : 0;
  const auto relax = [&](int x, int y, int u, int v) {
    if (u < 0 || v < 0 || u >= box.width || v >= box.height) return;
    int& here = distance[at(box, x, y)];
    here = std::min(here, distance[at(box, u, v)] + 1);
  };
  for (int y = 0; y < box.height; ++y)
    for (int x = 0; x < box.width; ++x)
      relax(x, y, x - 1, y), relax(x, y, x - 1, y - 1), relax(x, y, x, y - 1), relax(x, y, x + 1, y - 1);
  for (int y = box.height - 1; y >= 0; --y)
    for (int x = box.width - 1; x >= 0; --x)
      relax(x, y, x + 1, y), relax(x, y, x + 1, y + 1), relax(x, y, x, y + 1), relax(x, y, x - 1, y + 1);
  std::vector<char> is_open(distance.size());
  for (std::size_t i = 0; i < distance.size(); ++i) is_open[i] = distance[i] > margin;
  return is_open;
}

/// The farthest that each cell sees, and a pixel around it: what is a little farther than all of these is
/// hidden. The backdrop counts only well away from outlines: the model's are not exact, and through its
/// cracks a photograph shows the surface itself.
void add_depths(const LayerModel& model, const ItemBuffer& seen, const View& view, PackedFacade& facade) {
  const std::vector<char> is_open = open_backdrop(model, seen, int(std::lround(outline_margin * view.width)));
  const auto is_backdrop = [&](std::size_t i) {
    const std::uint32_t t = seen.triangles[i];
    return t != no_triangle_seen && model.objects[model.triangles[t].object].is_backdrop;
  };
  double farthest_surface = 0.0;
  for (std::size_t i = 0; i < seen.depths.size(); ++i)
    if (std::isfinite(seen.depths[i]) && !is_backdrop(i))
      farthest_surface = std::max(farthest_surface, double(seen.depths[i]));
  const glm::ivec2 cells = depth_cells(view);
  for (int row = 0; row < cells.y; ++row)
    for (int column = 0; column < cells.x; ++column) {
      double farthest = 0.0;
      for (int y = std::max(row * depth_cell - 1, 0); y <= std::min((row + 1) * depth_cell, view.height - 1);
           ++y)
        for (int x = std::max(column * depth_cell - 1, 0);
             x <= std::min((column + 1) * depth_cell, view.width - 1); ++x) {
          const std::size_t i = seen.index(x, y);
          if (is_open[i] || !is_backdrop(i)) farthest = std::max(farthest, double(seen.depths[i]));
        }
      facade.depths.push_back(encoded_depth(farthest > 0.0 ? farthest : farthest_surface));
    }
}

/// For each triangle the layers that hold it; equal lists are stored once.
void add_candidates(const PlaceLayers& place, const std::vector<std::vector<std::uint32_t>>& items,
                    const std::vector<std::uint32_t>& first_layer, PackedFacade& facade) {
  std::map<std::vector<std::uint32_t>, std::uint32_t> known;
  for (const std::uint32_t triangle : by_surface(place.model)) {
    std::vector<std::uint32_t> list;
    for (std::size_t i = 0; i < place.names.size(); ++i)
      if (const std::uint32_t item = items[i][triangle]; item != no_item)
        list.push_back(first_layer[i] + place.layered[i].layer_of_item[item]);
    const auto [at, is_new] = known.try_emplace(list, std::uint32_t(facade.candidates.size()));
    if (is_new) facade.candidates.insert(facade.candidates.end(), list.begin(), list.end());
    facade.lists.emplace_back(at->second, std::uint32_t(list.size()));
  }
}

void add_layers(const PlaceLayers& place, const std::vector<std::vector<std::uint32_t>>& items,
                std::size_t photo, const std::vector<std::uint32_t>& layers, PackedFacade& facade) {
  const std::size_t count = place.layered[photo].layers.size(), first_slot = facade.slot_count();
  const NeededPixels needed = needed_pixels(place, items, photo);
  PhotoTiles tiles;
  for (std::size_t l = 0; l < count; ++l) {
    PackedLayer packed{on_tile_grid(place.layered[photo].layers[l].box), std::uint32_t(photo),
                       std::uint32_t(facade.tiles.size())};
    tiles.add(layer_picture(place, photo, l, needed[l], layers), packed, first_slot, facade);
    facade.layers.push_back(packed);
  }
  std::vector<std::vector<Bc7Block>> blocks(tiles.slots().size());
  parallel_for(blocks.size(), [&](std::size_t slot) { blocks[slot] = blocks_of(tiles.slots()[slot]); });
  for (const std::vector<Bc7Block>& slot : blocks)
    facade.blocks.insert(facade.blocks.end(), slot.begin(), slot.end());
}

}  // namespace

PackedFacade packed_facade(const PlaceLayers& place) {
  PackedFacade facade;
  TriangleColours colours{std::vector<glm::dvec3>(place.model.triangles.size(), glm::dvec3(0.0)),
                          std::vector<double>(place.model.triangles.size(), 0.0)};
  std::vector<std::uint32_t> first_layer;
  std::vector<std::vector<std::uint32_t>> items;
  for (const VisibilityLayers& visibility : place.visibility)
    items.push_back(item_of_triangle(place.model, visibility.items));
  Progress progress("packing layers", place.names.size());
  for (std::size_t i = 0; i < place.names.size(); ++i) {
    facade.photos.push_back({place.names[i], place.views[i], place.balances[i]});
    first_layer.push_back(std::uint32_t(facade.layers.size()));
    const ItemBuffer seen = item_buffer(place.model, place.views[i]);
    const std::vector<std::uint32_t> layers = layers_of_pixels(place, i, seen);
    add_layers(place, items, i, layers, facade);
    add_depths(place.model, seen, place.views[i], facade);
    add_colours(place, i, seen, layers, colours);
    progress.advance();
  }
  add_surfaces(place, colours, facade);
  add_candidates(place, items, first_layer, facade);
  return facade;
}

}  // namespace parvis::facades
