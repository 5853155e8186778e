#include "capture/facades/layer_atlas.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace parvis::facades {
namespace {

struct Shelves {
  std::vector<glm::ivec2> offsets;
  int width = 0, height = 0;
};

/// Boxes with their borders, highest first, on shelves of `width` texels.
Shelves packed(const std::vector<ImageLayer>& layers, int width) {
  std::vector<std::size_t> order(layers.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return layers[i].box.height; });
  Shelves shelves{std::vector<glm::ivec2>(layers.size()), width, 0};
  int x = 0, shelf_height = 0;
  for (const std::size_t i : order) {
    const int w = layers[i].box.width + 2 * atlas_border, h = layers[i].box.height + 2 * atlas_border;
    if (x + w > width) shelves.height += shelf_height, x = 0, shelf_height = 0;
    shelves.offsets[i] = {x + atlas_border, shelves.height + atlas_border};
    x += w, shelf_height = std::max(shelf_height, h);
  }
  shelves.height = (shelves.height + shelf_height + 3) / 4 * 4;
  return shelves;
}

/// The tightest of several widths.
Shelves best_shelves(const std::vector<ImageLayer>& layers) {
  int widest = 4;
  double area = 0.0;
  for (const ImageLayer& layer : layers) {
    widest = std::max(widest, (layer.box.width + 2 * atlas_border + 3) / 4 * 4);
    area += double(layer.box.width + 2 * atlas_border) * (layer.box.height + 2 * atlas_border);
  }
  Shelves best;
  for (const double ratio : {0.7, 0.8, 0.9, 1.0, 1.1, 1.25, 1.4, 1.6, 2.0}) {
    const Shelves shelves = packed(layers, std::max(widest, int(std::sqrt(area) * ratio / 4.0) * 4 + 4));
    if (best.width == 0 ||
        std::int64_t(shelves.width) * shelves.height < std::int64_t(best.width) * best.height)
      best = shelves;
  }
  return best;
}

/// One ring of pixels around those that are covered takes the mean of its covered neighbours, `rings` times.
void dilate(Image8& part, std::vector<char>& is_covered, int rings) {
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<char> before = is_covered;
    for (int y = 0; y < part.height; ++y)
      for (int x = 0; x < part.width; ++x) {
        const std::size_t at = std::size_t(y) * std::size_t(part.width) + std::size_t(x);
        if (before[at]) continue;
        int sum[4] = {0, 0, 0, 0}, count = 0;
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, part.height - 1); ++v)
          for (int u = std::max(x - 1, 0); u <= std::min(x + 1, part.width - 1); ++u)
            if (before[std::size_t(v) * std::size_t(part.width) + std::size_t(u)]) {
              for (int c = 0; c < 4; ++c) sum[c] += part.at(u, v)[c];
              ++count;
            }
        if (!count) continue;
        for (int c = 0; c < 4; ++c) part.at(x, y)[c] = std::uint8_t((sum[c] + count / 2) / count);
        is_covered[at] = 1;
      }
  }
}

}  // namespace

LayerAtlas layer_atlas(const LayeredView& layered, const LayerPixels& pixels) {
  const Shelves shelves = best_shelves(layered.layers);
  LayerAtlas atlas{Image8(shelves.width, shelves.height, 4), Image8(shelves.width, shelves.height, 1),
                   shelves.offsets};
  for (std::size_t i = 0; i < layered.layers.size(); ++i) {
    const PixelBox& box = layered.layers[i].box;
    Image8 part(box.width + 2 * atlas_border, box.height + 2 * atlas_border, 4);
    std::vector<char> is_covered(std::size_t(part.width) * std::size_t(part.height), 0);
    const glm::ivec2 corner = atlas.offsets[i] - atlas_border;
    for (int y = 0; y < box.height; ++y)
      for (int x = 0; x < box.width; ++x) {
        if (!layered.masks[i].at(x, y)[0]) continue;
        std::copy_n(pixels[i].at(x, y), 4, part.at(x + atlas_border, y + atlas_border));
        is_covered[std::size_t(y + atlas_border) * std::size_t(part.width) + std::size_t(x + atlas_border)] =
            1;
        *atlas.seen.at(atlas.offsets[i].x + x, atlas.offsets[i].y + y) = layered.masks[i].at(x, y)[1];
      }
    dilate(part, is_covered, atlas_border);
    for (int y = 0; y < part.height; ++y)
      std::copy_n(part.at(0, y), 4 * part.width, atlas.colours.at(corner.x, corner.y + y));
  }
  return atlas;
}

}  // namespace parvis::facades
