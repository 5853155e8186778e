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

constexpr int dilation_rings = 6;  ///< pixels beyond a surface's edge that repeat it: filters and mipmaps
/// Of pixels that were filled, in mixed tiles: colours share a block's line with alpha, so that a larger step
/// would cost them most of their precision.
constexpr std::uint8_t unseen_alpha = 191;
constexpr std::size_t max_known_colours = 2000;  ///< that unknown surfaces are coloured from

/// A layer as it is stored, with what is needed of it.
struct LayerPicture {
  Image8 rgba;                   ///< of the box; alpha: seen or an artist's
  std::vector<char> is_covered;  ///< by a surface, dilated
  std::vector<char> is_needed;
  bool has_alpha = false;
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

LayerPicture layer_picture(const PlaceLayers& place, std::size_t photo, std::size_t l,
                           const std::vector<std::uint32_t>& layer_of_pixel) {
  const PixelBox& box = place.layered[photo].layers[l].box;
  const Filled& filled = place.filled[photo];
  LayerPicture picture{Image8(box.width, box.height, 4),
                       std::vector<char>(std::size_t(box.width) * std::size_t(box.height), 0),
                       {},
                       false};
  picture.is_needed = picture.is_covered;
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
      std::uint8_t* p = picture.rgba.at(x, y);
      std::copy_n(from.at(x, y), 4, p);
      if (source == FillSource::painted && p[3] < 255) picture.has_alpha = true;
      if (source != FillSource::painted) p[3] = is_certain ? 255 : unseen_alpha;
      picture.is_covered[at(box, x, y)] = 1;
      picture.is_needed[at(box, x, y)] = is_first || source == FillSource::painted ||
                                         source == FillSource::patches || source == FillSource::smooth;
    }
  // Alpha then is the artist's alone.
  if (picture.has_alpha)
    for (int y = 0; y < box.height; ++y)
      for (int x = 0; x < box.width; ++x)
        if (*filled.sources[l].at(x, y) != std::uint8_t(FillSource::painted)) picture.rgba.at(x, y)[3] = 255;
  dilate(picture);
  return picture;
}

/// The tile's texels; what is far from any surface takes the mean colour, which compresses best.
Image8 tile_texels(const LayerPicture& picture, int column, int row) {
  const PixelBox box{0, 0, picture.rgba.width, picture.rgba.height};
  Image8 tile(tile_side, tile_side, 4);
  std::vector<char> is_covered(std::size_t(tile_side) * tile_side, 0);
  std::array<long, 4> sum{};
  long count = 0;
  for (int y = 0; y < tile_side; ++y)
    for (int x = 0; x < tile_side; ++x) {
      const int px = std::clamp(column * tile_inner + x - tile_border, 0, box.width - 1),
                py = std::clamp(row * tile_inner + y - tile_border, 0, box.height - 1);
      if (!picture.is_covered[at(box, px, py)]) continue;
      std::copy_n(picture.rgba.at(px, py), 4, tile.at(x, y));
      is_covered[std::size_t(y * tile_side + x)] = 1;
      for (std::size_t c = 0; c < 4; ++c) sum[c] += tile.at(x, y)[c];
      ++count;
    }
  if (count > 0)
    for (int y = 0; y < tile_side; ++y)
      for (int x = 0; x < tile_side; ++x)
        if (!is_covered[std::size_t(y * tile_side + x)])
          for (std::size_t c = 0; c < 4; ++c) tile.at(x, y)[c] = std::uint8_t(sum[c] / count);
  return tile;
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

/// The needed tiles of a layer, compressed.
struct LayerTiles {
  std::vector<TileKind> kinds;
  std::vector<Bc7Block> blocks;
};

LayerTiles tiles_of(const LayerPicture& picture, const PackedLayer& layer) {
  LayerTiles tiles;
  for (int row = 0; row < layer.down(); ++row)
    for (int column = 0; column < layer.across(); ++column) {
      tiles.kinds.push_back(kind_of(picture, column, row));
      if (tiles.kinds.back() == TileKind::none) continue;
      Image8 texels = tile_texels(picture, column, row);
      if (tiles.kinds.back() == TileKind::seen)
        for (std::size_t i = 3; i < texels.pixels.size(); i += 4) texels.pixels[i] = 255;
      for (int level = 0; level < tile_levels; ++level) {
        std::ranges::copy(bc7_blocks(texels), std::back_inserter(tiles.blocks));
        texels = halved(texels);
      }
    }
  return tiles;
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
  NearestColours(const LayerModel& model, const TriangleColours& colours) {
    std::vector<std::size_t> known;
    for (std::size_t t = 0; t < colours.counts.size(); ++t)
      if (colours.counts[t] > 0.0) known.push_back(t);
    const std::size_t stride = known.size() / max_known_colours + 1;
    for (std::size_t i = 0; i < known.size(); i += stride) {
      const auto& c = model.triangles[known[i]].corners;
      points_.push_back((c[0] + c[1] + c[2]) / 3.0);
      colours_.push_back(colours.sums[known[i]] / colours.counts[known[i]]);
    }
  }
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
  const NearestColours nearest(place.model, colours);
  const std::vector<std::uint32_t> order = by_surface(place.model);
  facade.corners.resize(3 * order.size()), facade.fallback.resize(3 * order.size());
  facade.surface_of_triangle.resize(order.size());
  parallel_for(
      order.size(),
      [&](std::size_t i) {
        const LayerTriangle& triangle = place.model.triangles[order[i]];
        facade.surface_of_triangle[i] = triangle.object;
        for (std::size_t k = 0; k < 3; ++k) {
          facade.corners[3 * i + k] = glm::vec3(triangle.corners[k]);
          facade.fallback[3 * i + k] = nearest.at(triangle.corners[k]);
        }
      },
      64);
}

/// For each triangle the layers that hold it; equal lists are stored once.
void add_candidates(const PlaceLayers& place, const std::vector<std::uint32_t>& first_layer,
                    PackedFacade& facade) {
  std::vector<std::vector<std::uint32_t>> items;
  for (std::size_t i = 0; i < place.names.size(); ++i)
    items.push_back(item_of_triangle(place.model, place.visibility[i].items));
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

void add_layers(const PlaceLayers& place, std::size_t photo, const std::vector<std::uint32_t>& layers,
                PackedFacade& facade) {
  const std::size_t count = place.layered[photo].layers.size();
  std::vector<PackedLayer> packed(count);
  std::vector<LayerTiles> tiles(count);
  parallel_for(count, [&](std::size_t l) {
    packed[l] = {place.layered[photo].layers[l].box, std::uint32_t(photo), 0};
    tiles[l] = tiles_of(layer_picture(place, photo, l, layers), packed[l]);
  });
  for (std::size_t l = 0; l < count; ++l) {
    packed[l].first_tile = std::uint32_t(facade.tiles.size());
    std::uint32_t slot = std::uint32_t(facade.slot_count());
    for (const TileKind kind : tiles[l].kinds)
      facade.tiles.push_back(std::uint32_t(kind) | (kind == TileKind::none ? 0u : slot++ << 2));
    facade.blocks.insert(facade.blocks.end(), tiles[l].blocks.begin(), tiles[l].blocks.end());
    facade.layers.push_back(packed[l]);
  }
}

}  // namespace

PackedFacade packed_facade(const PlaceLayers& place) {
  PackedFacade facade;
  TriangleColours colours{std::vector<glm::dvec3>(place.model.triangles.size(), glm::dvec3(0.0)),
                          std::vector<double>(place.model.triangles.size(), 0.0)};
  std::vector<std::uint32_t> first_layer;
  Progress progress("packing layers", place.names.size());
  for (std::size_t i = 0; i < place.names.size(); ++i) {
    facade.photos.push_back({place.names[i], place.views[i], place.balances[i]});
    first_layer.push_back(std::uint32_t(facade.layers.size()));
    const ItemBuffer seen = item_buffer(place.model, place.views[i]);
    const std::vector<std::uint32_t> layers = layers_of_pixels(place, i, seen);
    add_layers(place, i, layers, facade);
    add_colours(place, i, seen, layers, colours);
    progress.advance();
  }
  add_surfaces(place, colours, facade);
  add_candidates(place, first_layer, facade);
  return facade;
}

}  // namespace parvis::facades
