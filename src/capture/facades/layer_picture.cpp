#include "capture/facades/layer_picture.h"

#include <algorithm>
#include <array>

namespace parvis::facades {
namespace {

/// Uncovered pixels next to covered ones take their mean, ring by ring.
void dilate(LayerPicture& picture) {
  const int width = picture.rgba.width, height = picture.rgba.height;
  const PixelBox box{0, 0, width, height};
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

/// Hidden parts of the backdrop are in no layer but may be looked up: alpha 0 says that nothing is known
/// there.
void hide_rest(LayerPicture& picture) {
  for (std::size_t i = 0; i < picture.is_own.size(); ++i)
    if (!picture.is_own[i])
      picture.rgba.pixels[4 * i + 3] = unknown_alpha, picture.is_own[i] = picture.is_covered[i] = 1;
}

bool holds_backdrop(const PlaceLayers& place, std::size_t photo, std::size_t layer) {
  return std::ranges::any_of(place.layered[photo].layers[layer].items, [&](std::uint32_t item) {
    return place.model.objects[place.visibility[photo].items[item].object].is_backdrop;
  });
}

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

}  // namespace

std::vector<Image8> needed_pixels(const PlaceLayers& place,
                                  const std::vector<std::vector<std::uint32_t>>& items, std::size_t photo) {
  const LayeredView& layered = place.layered[photo];
  const View& view = place.views[photo];
  std::vector<Image8> needed;
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

PixelBox on_tile_grid(const PixelBox& box) {
  const int x = box.x / tile_inner * tile_inner, y = box.y / tile_inner * tile_inner;
  return {x, y, box.x + box.width - x, box.y + box.height - y};
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
      // What hides a surface is not its colour: without a proposal nothing is known of it.
      const bool is_known = is_certain || is_first || takes_proposal;
      if (source != FillSource::painted) p[3] = is_certain ? 255 : is_known ? unseen_alpha : unknown_alpha;
      picture.is_covered[at(grid, x + left, y + top)] = 1;
      picture.is_needed[at(grid, x + left, y + top)] = is_first || (is_known && *needed.at(x, y) != 0);
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

}  // namespace parvis::facades
