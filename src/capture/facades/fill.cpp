// Departure from deliverable 6's "patch synthesis": one shift for each connected hole of a plane instead of
// one for each pixel; facades repeat by whole windows, and a hole then never mixes two of them.
#include "capture/facades/fill.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "base/colour.h"
#include "base/parallel.h"
#include "capture/facades/item_buffer.h"
#include "capture/facades/novel_view.h"
#include "capture/facades/plane_patch.h"

namespace parvis::facades {
namespace {

constexpr int max_grid_side = 400;  ///< points of a rectified plane; larger ones are sampled more coarsely
constexpr float max_fill_contradiction = 0.15f;  ///< of photographs that are to say what is hidden
constexpr int min_hole_pixels = 4;               ///< holes of fewer pixels on a plane are not worth a search

std::uint8_t& source_of(Filled& filled, std::size_t layer, int x, int y) {
  return *filled.sources[layer].at(x, y);
}

void set_colour(Filled& filled, std::size_t layer, int x, int y, glm::vec3 srgb, FillSource source) {
  std::uint8_t* p = filled.pixels[layer].at(x, y);
  for (int c = 0; c < 3; ++c) p[c] = std::uint8_t(std::lround(255.0f * glm::clamp(srgb[c], 0.0f, 1.0f)));
  source_of(filled, layer, x, y) = std::uint8_t(source);
}

/// Marks the pixels of each layer that the photograph shows, less a rim next to whatever hides it.
void mark_seen(const LayersOfModel& layers, int rim, Filled& filled) {
  for (std::size_t l = 0; l < layers.layered.layers.size(); ++l) {
    const Image8& mask = layers.layered.masks[l];
    filled.sources.emplace_back(mask.width, mask.height, 1);
    const auto is_hidden = [&](int x, int y) {
      return x >= 0 && y >= 0 && x < mask.width && y < mask.height && mask.at(x, y)[0] && !mask.at(x, y)[1];
    };
    for (int y = 0; y < mask.height; ++y)
      for (int x = 0; x < mask.width; ++x) {
        if (!mask.at(x, y)[1]) continue;
        bool is_by_rim = false;
        for (int v = y - rim; v <= y + rim; ++v)
          for (int u = x - rim; u <= x + rim; ++u) is_by_rim |= is_hidden(u, v);
        if (!is_by_rim) source_of(filled, l, x, y) = std::uint8_t(FillSource::seen);
      }
  }
}

/// A covered pixel of a layer with the surface in it.
struct LayerPixel {
  int x, y;  ///< of the photograph
  float depth;
  std::uint32_t triangle;
};

/// All covered pixels of every layer.
std::vector<std::vector<LayerPixel>> covered_pixels(const LayersOfModel& layers) {
  const std::vector<std::uint32_t> item_of = item_of_triangle(layers.model, layers.visibility.items);
  std::vector<std::vector<std::pair<std::uint32_t, LayerPixel>>> rows(std::size_t(layers.view.height));
  visit_stacks(layers.model, layers.view, false, {}, [&](int x, int y, std::span<const Fragment> stack) {
    for (const Fragment& fragment : stack)
      if (const std::uint32_t item = item_of[fragment.triangle];
          item != no_item && has_layer_pixel(layers.model, fragment, stack))
        rows[std::size_t(y)].push_back(
            {layers.layered.layer_of_item[item], {x, y, float(fragment.depth), fragment.triangle}});
  });
  std::vector<std::vector<LayerPixel>> pixels(layers.layered.layers.size());
  for (const auto& row : rows)
    for (const auto& [layer, pixel] : row) pixels[layer].push_back(pixel);
  return pixels;
}

/// The photographs without one: what they say about points that it does not show.
std::vector<PreparedPhoto> others_of(std::span<const PreparedPhoto> photos, std::size_t own) {
  std::vector<PreparedPhoto> others;
  for (std::size_t i = 0; i < photos.size(); ++i)
    if (i != own) others.push_back(photos[i]);
  return others;
}

void fill_from_photographs(const LayersOfModel& layers, const std::vector<std::vector<LayerPixel>>& covered,
                           std::span<const PreparedPhoto> others, Filled& filled) {
  BlendSettings settings;
  settings.max_contradiction = max_fill_contradiction;
  for (std::size_t l = 0; l < covered.size(); ++l) {
    const PixelBox& box = layers.layered.layers[l].box;
    parallel_for(
        covered[l].size(),
        [&](std::size_t k) {
          const LayerPixel& pixel = covered[l][k];
          if (source_of(filled, l, pixel.x - box.x, pixel.y - box.y) != std::uint8_t(FillSource::none))
            return;
          const glm::dvec3 point = layers.view.to_world({pixel.x + 0.5, pixel.y + 0.5}, pixel.depth);
          std::vector<Opinion> found =
              opinions(others, settings, point, layers.view.centre, pixel.depth / layers.view.fx);
          std::erase_if(found, [](const Opinion& o) { return o.confidence < 0.3f; });
          const glm::vec4 colour = blended(found, settings.best, settings.max_contradiction);
          if (colour.w > 0.0f)
            set_colour(filled, l, pixel.x - box.x, pixel.y - box.y, srgb_from_linear(glm::vec3(colour)),
                       FillSource::photographs);
        },
        256);
  }
}

/// The pixels of one plane in one layer, rectified: a grid point for each, of the size of their mean
/// footprint.
struct RectifiedPlane {
  PlaneGrid grid;
  std::vector<glm::ivec2> place_of_pixel;
};

RectifiedPlane rectified(const LayersOfModel& layers, const std::vector<LayerPixel>& pixels,
                         const PixelBox& box, std::size_t layer, Filled& filled) {
  const PlaneFrame frame = frame_of(layers.model.triangles[pixels[0].triangle]);
  std::vector<glm::dvec2> places;
  glm::dvec2 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  double footprint = 0.0;
  for (const LayerPixel& pixel : pixels) {
    const glm::dvec3 p = layers.view.to_world({pixel.x + 0.5, pixel.y + 0.5}, pixel.depth) - frame.origin;
    places.push_back({glm::dot(p, frame.u), glm::dot(p, frame.v)});
    low = glm::min(low, places.back()), high = glm::max(high, places.back());
    footprint += pixel.depth / layers.view.fx / double(pixels.size());
  }
  // Coarser than the pixels on average, so that nearly every grid point gets one even where the plane is seen
  // at an angle.
  const double step =
      std::max({1.5 * footprint, (high.x - low.x) / max_grid_side, (high.y - low.y) / max_grid_side, 1e-12});
  RectifiedPlane plane{PlaneGrid(int((high.x - low.x) / step) + 1, int((high.y - low.y) / step) + 1), {}};
  std::vector<float> counts(plane.grid.colours.size(), 0.0f);
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    const glm::ivec2 place((places[k] - low) / step);
    plane.place_of_pixel.push_back(place);
    const std::size_t i = plane.grid.index(place.x, place.y);
    const int x = pixels[k].x - box.x, y = pixels[k].y - box.y;
    if (source_of(filled, layer, x, y) == std::uint8_t(FillSource::none)) {
      plane.grid.is_missing[i] = 1;
    } else {
      const std::uint8_t* p = filled.pixels[layer].at(x, y);
      plane.grid.colours[i] += glm::vec3(p[0], p[1], p[2]) / 255.0f, ++counts[i];
    }
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0.0f) plane.grid.colours[i] /= counts[i];
    plane.grid.is_known[i] = counts[i] > 0.0f && !plane.grid.is_missing[i];
  }
  return plane;
}

using FillGrid = std::vector<char> (*)(PlaneGrid&);

void fill_planes(const LayersOfModel& layers, const std::vector<std::vector<LayerPixel>>& covered,
                 FillGrid fill, FillSource source, Filled& filled) {
  parallel_for(covered.size(), [&](std::size_t l) {
    const PixelBox& box = layers.layered.layers[l].box;
    std::map<std::uint32_t, std::vector<LayerPixel>> by_face;
    for (const LayerPixel& pixel : covered[l])
      by_face[layers.model.triangles[pixel.triangle].face].push_back(pixel);
    for (const auto& [face, pixels] : by_face) {
      const auto is_open = [&](const LayerPixel& p) {
        return source_of(filled, l, p.x - box.x, p.y - box.y) == std::uint8_t(FillSource::none);
      };
      const auto holes = std::ranges::count_if(pixels, is_open);
      if (holes < min_hole_pixels || holes == std::ptrdiff_t(pixels.size())) continue;
      RectifiedPlane plane = rectified(layers, pixels, box, l, filled);
      const std::vector<char> done = fill(plane.grid);
      for (std::size_t k = 0; k < pixels.size(); ++k) {
        const std::size_t i = plane.grid.index(plane.place_of_pixel[k].x, plane.place_of_pixel[k].y);
        if (done[i] && is_open(pixels[k]))
          set_colour(filled, l, pixels[k].x - box.x, pixels[k].y - box.y, plane.grid.colours[i], source);
      }
    }
  });
}

/// Plain inpainting of whole layers in the picture, for what no plane could fill; a layer of which nothing is
/// known takes the mean of the photograph's layers.
void fill_rest(const LayersOfModel& layers, Filled& filled) {
  parallel_for(layers.layered.layers.size(), [&](std::size_t l) {
    const Image8& mask = layers.layered.masks[l];
    PlaneGrid grid(mask.width, mask.height);
    bool is_any_missing = false;
    for (int y = 0; y < mask.height; ++y)
      for (int x = 0; x < mask.width; ++x) {
        const std::size_t i = grid.index(x, y);
        const bool is_open = source_of(filled, l, x, y) == std::uint8_t(FillSource::none);
        grid.is_missing[i] = mask.at(x, y)[0] && is_open, grid.is_known[i] = mask.at(x, y)[0] && !is_open;
        is_any_missing |= grid.is_missing[i] != 0;
        const std::uint8_t* p = filled.pixels[l].at(x, y);
        grid.colours[i] = glm::vec3(p[0], p[1], p[2]) / 255.0f;
      }
    if (!is_any_missing) return;
    const std::vector<char> done = fill_smoothly(grid);
    glm::vec3 mean(0.0f);
    float known = 0.0f;
    for (std::size_t i = 0; i < grid.colours.size(); ++i)
      if (grid.is_known[i] || done[i]) mean += grid.colours[i], ++known;
    mean = known > 0.0f ? mean / known : glm::vec3(0.5f);
    for (int y = 0; y < mask.height; ++y)
      for (int x = 0; x < mask.width; ++x)
        if (mask.at(x, y)[0] && source_of(filled, l, x, y) == std::uint8_t(FillSource::none))
          set_colour(filled, l, x, y, done[grid.index(x, y)] ? grid.colours[grid.index(x, y)] : mean,
                     FillSource::smooth);
  });
}

}  // namespace

Filled filled_layers(const LayersOfModel& layers, std::span<const PreparedPhoto> photos, std::size_t own,
                     const LayerPixels& pixels, const FillSettings& settings) {
  Filled filled{pixels, {}, std::vector<Filling>(pixels.size(), Filling::none)};
  mark_seen(layers, settings.rim, filled);
  const std::vector<std::vector<LayerPixel>> covered = covered_pixels(layers);
  if (settings.from_photographs) fill_from_photographs(layers, covered, others_of(photos, own), filled);
  if (settings.by_patches) fill_planes(layers, covered, fill_by_shifts, FillSource::patches, filled);
  fill_planes(layers, covered, fill_smoothly, FillSource::smooth, filled);
  fill_rest(layers, filled);
  for (std::size_t l = 0; l < pixels.size(); ++l)
    if (std::ranges::any_of(filled.sources[l].pixels,
                            [](std::uint8_t s) { return s > std::uint8_t(FillSource::seen); }))
      filled.states[l] = Filling::proposal;
  return filled;
}

LayerPixels chosen_pixels(const Filled& filled, const LayerPixels& unfilled) {
  LayerPixels chosen = filled.pixels;
  for (std::size_t l = 0; l < chosen.size(); ++l)
    if (filled.states[l] == Filling::refused) chosen[l] = unfilled[l];
  return chosen;
}

}  // namespace parvis::facades
