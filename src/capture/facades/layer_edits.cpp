#include "capture/facades/layer_edits.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>
#include <span>
#include <unordered_map>

#include "base/sealed_file.h"
#include "capture/facades/item_buffer.h"

namespace parvis::facades {
namespace {

constexpr SealedKind edits_kind{"PVFEDIT1", "edits of layers"};

bool differs(const std::uint8_t* a, const std::uint8_t* b) {
  return a[3] != b[3] || (b[3] > 0 && !std::equal(a, a + 3, b));
}

/// Where every edit is to go.
struct Places {
  const LayerEdits& edits;
  std::unordered_map<std::uint64_t, std::vector<std::pair<std::uint32_t, std::uint32_t>>>
      at;  ///< of a pixel: object edits, pixel

  explicit Places(const LayerEdits& all) : edits(all) {
    for (std::uint32_t o = 0; o < all.size(); ++o)
      for (std::uint32_t p = 0; p < all[o].pixels.size(); ++p)
        at[key(all[o].pixels[p].x, all[o].pixels[p].y)].push_back({o, p});
  }
  static std::uint64_t key(int x, int y) { return std::uint64_t(std::uint32_t(y)) << 32 | std::uint32_t(x); }
};

/// The fragment of the edit's object that lies nearest to the depth that was painted; null: none is near
/// enough.
const Fragment* surface_of(const LayersOfModel& layers, const std::vector<std::uint32_t>& item_of,
                           std::span<const Fragment> stack, const std::string& object, float depth) {
  const Fragment* best = nullptr;
  for (const Fragment& fragment : stack) {
    const LayerTriangle& triangle = layers.model.triangles[fragment.triangle];
    if (item_of[fragment.triangle] == no_item || !has_layer_pixel(layers.model, fragment, stack) ||
        layers.model.objects[triangle.object].name != object)
      continue;
    const double off = std::abs(fragment.depth - depth);
    if (off <= same_surface_tolerance * depth && (!best || off < std::abs(best->depth - depth)))
      best = &fragment;
  }
  return best;
}

std::string where(const std::vector<EditedPixel>& pixels) {
  int x0 = pixels[0].x, x1 = x0, y0 = pixels[0].y, y1 = y0;
  for (const EditedPixel& p : pixels) {
    x0 = std::min(x0, p.x), x1 = std::max(x1, p.x);
    y0 = std::min(y0, p.y), y1 = std::max(y1, p.y);
  }
  return fmt::format("{} x {} at {},{}", x1 - x0 + 1, y1 - y0 + 1, x0, y0);
}

}  // namespace

LayerEdits edits_of(const LayersOfModel& layers, const LayerPixels& before, const LayerPixels& after) {
  const std::vector<std::uint32_t> item_of = item_of_triangle(layers.model, layers.visibility.items);
  std::map<std::pair<std::string, std::string>, std::vector<EditedPixel>> found;
  std::mutex mutex;
  visit_stacks(layers.model, layers.view, false, {}, [&](int x, int y, std::span<const Fragment> stack) {
    for (const Fragment& fragment : stack) {
      const std::uint32_t item = item_of[fragment.triangle];
      if (item == no_item || !has_layer_pixel(layers.model, fragment, stack)) continue;
      const std::uint32_t l = layers.layered.layer_of_item[item];
      const ImageLayer& layer = layers.layered.layers[l];
      const std::uint8_t* painted = after[l].at(x - layer.box.x, y - layer.box.y);
      if (!differs(before[l].at(x - layer.box.x, y - layer.box.y), painted)) continue;
      const std::string& object = layers.model.objects[layers.model.triangles[fragment.triangle].object].name;
      const std::lock_guard lock(mutex);
      found[{object, layer.name}].push_back(
          {x, y, float(fragment.depth), {painted[0], painted[1], painted[2], painted[3]}});
    }
  });
  LayerEdits edits;
  for (auto& [names, pixels] : found) {
    std::ranges::sort(pixels, {}, [](const EditedPixel& p) { return std::pair(p.y, p.x); });
    edits.push_back({names.first, names.second, std::move(pixels)});
  }
  return edits;
}

AppliedEdits apply(const LayerEdits& edits, const LayersOfModel& layers, const std::string& photograph,
                   LayerPixels& pixels) {
  const std::vector<std::uint32_t> item_of = item_of_triangle(layers.model, layers.visibility.items);
  const Places places(edits);
  std::vector<std::vector<char>> is_placed;
  for (const ObjectEdits& object : edits) is_placed.emplace_back(object.pixels.size(), char(0));
  visit_stacks(layers.model, layers.view, false, {}, [&](int x, int y, std::span<const Fragment> stack) {
    const auto here = places.at.find(Places::key(x, y));
    if (here == places.at.end()) return;
    for (const auto& [o, p] : here->second) {
      const EditedPixel& edit = edits[o].pixels[p];
      const Fragment* surface = surface_of(layers, item_of, stack, edits[o].object, edit.depth);
      if (!surface) continue;
      const std::uint32_t l = layers.layered.layer_of_item[item_of[surface->triangle]];
      const PixelBox& box = layers.layered.layers[l].box;
      std::ranges::copy(edit.rgba, pixels[l].at(x - box.x, y - box.y));
      is_placed[o][p] = 1;
    }
  });
  AppliedEdits result;
  for (std::size_t o = 0; o < edits.size(); ++o) {
    ObjectEdits left{edits[o].object, edits[o].layer, {}};
    for (std::size_t p = 0; p < edits[o].pixels.size(); ++p)
      if (is_placed[o][p])
        ++result.applied;
      else
        left.pixels.push_back(edits[o].pixels[p]);
    if (left.pixels.empty()) continue;
    const bool has_object = std::ranges::find(layers.model.objects, left.object, &LayerObject::name) !=
                            layers.model.objects.end();
    result.messages.push_back(error(
        "photograph {}: {} of {} edited pixels of object \"{}\" (layer \"{}\", {}) no longer fit: {}; they "
        "are kept",
        photograph, left.pixels.size(), edits[o].pixels.size(), left.object, left.layer, where(left.pixels),
        has_object ? "its surface has moved away from there" : "the model has no such object any more"));
    result.unplaced.push_back(std::move(left));
  }
  return result;
}

LayerEdits joined(const LayerEdits& earlier, const LayerEdits& later) {
  LayerEdits result = earlier;
  for (const ObjectEdits& edits : later) {
    std::unordered_map<std::uint64_t, float> painted;
    for (const EditedPixel& p : edits.pixels) painted[Places::key(p.x, p.y)] = p.depth;
    for (ObjectEdits& old : result)
      if (old.object == edits.object)
        std::erase_if(old.pixels, [&](const EditedPixel& p) {
          const auto over = painted.find(Places::key(p.x, p.y));
          return over != painted.end() &&
                 std::abs(over->second - p.depth) <= same_surface_tolerance * p.depth;
        });
    result.push_back(edits);
  }
  std::erase_if(result, [](const ObjectEdits& edits) { return edits.pixels.empty(); });
  return result;
}

Status write_edits(const std::filesystem::path& file, const LayerEdits& edits) {
  std::string bytes;
  append_value(bytes, std::uint32_t(edits.size()));
  for (const ObjectEdits& object : edits) {
    append_values(bytes, std::vector<char>(object.object.begin(), object.object.end()));
    append_values(bytes, std::vector<char>(object.layer.begin(), object.layer.end()));
    append_values(bytes, object.pixels);
  }
  return write_sealed(file, edits_kind, bytes);
}

Result<LayerEdits> read_edits(const std::filesystem::path& file) {
  const Result<std::string> content = read_sealed(file, edits_kind);
  if (!content) return content.errors();
  ByteReader reader(*content);
  LayerEdits edits;
  for (std::uint32_t count = reader.take<std::uint32_t>(); count && !reader.has_ended_early(); --count) {
    const std::vector<char> object = reader.take_values<char>(), layer = reader.take_values<char>();
    edits.push_back(
        {{object.begin(), object.end()}, {layer.begin(), layer.end()}, reader.take_values<EditedPixel>()});
  }
  if (!reader.is_at_end()) return cut_short(file);
  return edits;
}

}  // namespace parvis::facades
