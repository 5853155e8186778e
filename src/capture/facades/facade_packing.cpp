// Departure from 3.6.1: a layer's texture is not one rectangle with a sheared frustum but the tiles of it
// that are needed; texels stay the photograph's own, and the frustum's matrix is the photograph's with the
// tile's place added.
#include <algorithm>
#include <cmath>
#include <map>

#include "base/parallel.h"
#include "capture/facades/packed_facade.h"
#include "capture/facades/photo_tiles.h"
#include "capture/facades/surface_colours.h"

namespace parvis::facades {
namespace {

constexpr double outline_margin = 0.01;  ///< of the picture's width: how exact outlines before a backdrop are

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

/// Flags of pixels that show the backdrop, more than `margin` pixels away from what lies before it, by
/// chessboard steps in two passes (Rosenfeld and Pfaltz 1966).
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

/// Adds the layers that hold each triangle; equal lists are stored once.
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
  const std::vector<Image8> needed = needed_pixels(place, items, photo);
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
  TriangleColours colours(place.model.triangles.size());
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
