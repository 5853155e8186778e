#include "capture/facades/image_layers.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <mutex>
#include <span>

#include "capture/facades/item_buffer.h"

namespace parvis::facades {
namespace {

/// Pixels saved when two boxes become one.
std::int64_t saving(const PixelBox& a, const PixelBox& b, int min_side) {
  return texture_area(a, min_side) + texture_area(b, min_side) - texture_area(united(a, b), min_side);
}

struct Cluster {
  PixelBox box;
  std::vector<std::uint32_t> members;
  std::size_t partner = 0;  ///< saves most
  std::int64_t saves = 0;   ///< with it; <= 0: none
};

void find_partner(std::vector<Cluster>& clusters, std::size_t i, int min_side) {
  clusters[i].saves = 0;
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    if (k == i) continue;
    const std::int64_t saves = saving(clusters[i].box, clusters[k].box, min_side);
    if (saves > clusters[i].saves) clusters[i].saves = saves, clusters[i].partner = k;
  }
}

/// Merges the pair that saves most until none saves anything.
void merge_greedily(std::vector<Cluster>& clusters, int min_side) {
  for (std::size_t i = 0; i < clusters.size(); ++i) find_partner(clusters, i, min_side);
  while (!clusters.empty()) {
    const auto best = std::ranges::max_element(clusters, {}, &Cluster::saves);
    if (best->saves <= 0) break;
    const std::size_t kept = std::min(std::size_t(best - clusters.begin()), best->partner);
    const std::size_t gone = std::max(std::size_t(best - clusters.begin()), best->partner);
    Cluster& into = clusters[kept];
    into.box = united(into.box, clusters[gone].box);
    into.members.insert(into.members.end(), clusters[gone].members.begin(), clusters[gone].members.end());
    const std::size_t last = clusters.size() - 1;
    if (gone != last) clusters[gone] = std::move(clusters[last]);
    clusters.pop_back();
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      Cluster& cluster = clusters[i];
      if (i == kept || (cluster.saves > 0 && (cluster.partner == gone || cluster.partner == kept))) {
        find_partner(clusters, i, min_side);
      } else {
        if (cluster.saves > 0 && cluster.partner == last) cluster.partner = gone;
        if (const std::int64_t saves = saving(cluster.box, clusters[kept].box, min_side);
            saves > cluster.saves)
          cluster.saves = saves, cluster.partner = kept;
      }
    }
  }
}

/// The search for partners is quadratic: many boxes are merged by halves of the picture first. The last
/// merging still is over all.
constexpr std::size_t max_boxes_at_once = 128;
void merge_halves(std::vector<Cluster>& clusters, int min_side) {
  if (clusters.size() > max_boxes_at_once) {
    PixelBox all = clusters.front().box;
    for (const Cluster& cluster : clusters) all = united(all, cluster.box);
    const auto middle = clusters.begin() + std::ptrdiff_t(clusters.size() / 2);
    std::ranges::nth_element(clusters, middle, {}, [&](const Cluster& cluster) {
      const PixelBox& b = cluster.box;
      return all.width > all.height ? std::tuple(2 * b.x + b.width, cluster.members)
                                    : std::tuple(2 * b.y + b.height, cluster.members);
    });
    std::vector<Cluster> second(std::make_move_iterator(middle), std::make_move_iterator(clusters.end()));
    clusters.erase(middle, clusters.end());
    merge_halves(clusters, min_side);
    merge_halves(second, min_side);
    std::ranges::move(second, std::back_inserter(clusters));
  }
  merge_greedily(clusters, min_side);
}

std::string three_digits(std::size_t n) { return fmt::format("{:03}", n); }

/// The object with most items in a layer names it.
std::string main_object(const LayerModel& model, const VisibilityLayers& visibility,
                        const std::vector<std::uint32_t>& items) {
  std::map<std::uint32_t, int> counts;
  for (const std::uint32_t item : items) ++counts[visibility.items[item].object];
  const auto maximum = std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; });
  return model.objects[maximum->first].name +
         (counts.size() > 1 ? fmt::format(" +{}", counts.size() - 1) : "");
}

/// Bounding boxes of the pixel centres that each item covers.
std::vector<PixelBox> covered_boxes(const LayerModel& model, const View& view,
                                    const std::vector<std::uint32_t>& item_of, std::size_t count) {
  struct Extent {
    int x0 = std::numeric_limits<int>::max(), y0 = x0, x1 = -1, y1 = -1;
  };
  std::vector<Extent> extents(count);
  std::mutex mutex;
  visit_stacks(model, view, false, {}, [&](int x, int y, std::span<const Fragment> stack) {
    const std::lock_guard lock(mutex);
    for (const Fragment& fragment : stack) {
      const std::uint32_t item = item_of[fragment.triangle];
      if (item == no_item || !has_layer_pixel(model, fragment, stack)) continue;
      Extent& e = extents[item];
      e.x0 = std::min(e.x0, x), e.y0 = std::min(e.y0, y), e.x1 = std::max(e.x1, x), e.y1 = std::max(e.y1, y);
    }
  });
  std::vector<PixelBox> boxes;
  for (const Extent& e : extents) boxes.push_back({e.x0, e.y0, e.x1 - e.x0 + 1, e.y1 - e.y0 + 1});
  return boxes;
}

void draw_masks(const LayerModel& model, const View& view, const std::vector<std::uint32_t>& item_of,
                LayeredView& result) {
  for (const ImageLayer& layer : result.layers)
    result.masks.emplace_back(layer.box.width, layer.box.height, 2);
  visit_stacks(model, view, false, {}, [&](int x, int y, std::span<const Fragment> stack) {
    for (const Fragment& fragment : stack) {
      const std::uint32_t item = item_of[fragment.triangle];
      if (item == no_item || !has_layer_pixel(model, fragment, stack)) continue;
      const std::uint32_t layer = result.layer_of_item[item];
      const PixelBox& box = result.layers[layer].box;
      std::uint8_t* mask = result.masks[layer].at(x - box.x, y - box.y);  // pixels of a row are one thread's
      mask[0] = 255;
      if (&fragment == &stack.front()) mask[1] = 255;
    }
  });
}

}  // namespace

PixelBox united(const PixelBox& a, const PixelBox& b) {
  const int x = std::min(a.x, b.x), y = std::min(a.y, b.y);
  return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

int power_of_two_side(int n) { return int(std::bit_ceil(unsigned(std::max(n, 1)))); }

std::int64_t texture_area(const PixelBox& box, int min_side) {
  return std::int64_t(power_of_two_side(std::max(box.width, min_side))) *
         power_of_two_side(std::max(box.height, min_side));
}

std::vector<std::vector<std::uint32_t>> merged_boxes(const std::vector<PixelBox>& boxes, int min_side) {
  std::vector<Cluster> clusters;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) clusters.push_back({boxes[i], {i}, 0, 0});
  merge_halves(clusters, min_side);
  std::vector<std::vector<std::uint32_t>> groups;
  for (Cluster& cluster : clusters) {
    std::ranges::sort(cluster.members);
    groups.push_back(std::move(cluster.members));
  }
  std::ranges::sort(groups);
  return groups;
}

LayeredView image_layers(const LayerModel& model, const View& view, const VisibilityLayers& visibility,
                         int min_side) {
  LayeredView result;
  result.layer_of_item.assign(visibility.items.size(), no_item);
  const std::vector<std::uint32_t> item_of = item_of_triangle(model, visibility.items);
  const std::vector<PixelBox> boxes = covered_boxes(model, view, item_of, visibility.items.size());
  for (std::uint32_t v = 0; v < visibility.layers.size(); ++v) {
    std::vector<PixelBox> of_layer;
    for (const std::uint32_t item : visibility.layers[v]) of_layer.push_back(boxes[item]);
    std::size_t number = 0;
    for (const std::vector<std::uint32_t>& group : merged_boxes(of_layer, min_side)) {
      ImageLayer layer;
      layer.visibility = v;
      layer.box = of_layer[group.front()];
      for (const std::uint32_t member : group) {
        layer.items.push_back(visibility.layers[v][member]);
        layer.box = united(layer.box, of_layer[member]);
        result.layer_of_item[layer.items.back()] = std::uint32_t(result.layers.size());
      }
      layer.name =
          fmt::format("L{:02}-{} {}", v, three_digits(number++), main_object(model, visibility, layer.items));
      result.layers.push_back(std::move(layer));
    }
  }
  draw_masks(model, view, item_of, result);
  return result;
}

Frustum frustum_of(const View& view) {
  return {-view.cx / view.fx, (view.width - view.cx) / view.fx, -(view.height - view.cy) / view.fy,
          view.cy / view.fy};
}

void distrust(const ImageF& trust, LayeredView& layered) {
  for (std::size_t l = 0; l < layered.layers.size(); ++l) {
    const PixelBox& box = layered.layers[l].box;
    for (int y = 0; y < box.height; ++y)
      for (int x = 0; x < box.width; ++x)
        if (*trust.at(x + box.x, y + box.y) < 0.5f) layered.masks[l].at(x, y)[1] = 0;
  }
}

Frustum sheared(const Frustum& frustum, const PixelBox& box, int width, int height) {
  const double per_column = (frustum.x_max - frustum.x_min) / width,
               per_row = (frustum.y_max - frustum.y_min) / height;
  return {frustum.x_min + box.x * per_column, frustum.x_min + (box.x + box.width) * per_column,
          frustum.y_max - (box.y + box.height) * per_row, frustum.y_max - box.y * per_row};
}

glm::dmat4 texture_from_world(const View& view, const PixelBox& box) {
  const Frustum f = sheared(frustum_of(view), box, view.width, view.height);
  glm::dmat4 camera_from_world(view.camera_from_world);
  camera_from_world[3] = glm::dvec4(-(view.camera_from_world * view.centre), 1.0);
  // The view's y points down, the frustum's up: t = (y_max + y / z) / (y_max - y_min).
  glm::dmat4 texture_from_camera(0.0);
  texture_from_camera[0][0] = 1.0 / (f.x_max - f.x_min);
  texture_from_camera[2][0] = -f.x_min / (f.x_max - f.x_min);
  texture_from_camera[1][1] = 1.0 / (f.y_max - f.y_min);
  texture_from_camera[2][1] = f.y_max / (f.y_max - f.y_min);
  texture_from_camera[2][2] = 1.0;
  texture_from_camera[2][3] = 1.0;
  return texture_from_camera * camera_from_world;
}

}  // namespace parvis::facades
