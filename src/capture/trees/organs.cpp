#include "capture/trees/organs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "base/colour.h"
#include "base/parallel.h"
#include "capture/trees/bark_texture.h"

namespace parvis::trees {
namespace {

constexpr float min_log_ratio = -0.8f, max_log_ratio = 0.8f;  // of green over red, of the histogram
constexpr int ratio_bins = 128;
constexpr float min_separation = 0.16f;      // of the two classes' means: below it the tree is of one kind
constexpr float min_leaf_log_ratio = 0.08f;  // bark that the sky lights is bluish, but not greener than this
constexpr float leaf_log_ratio = 0.12f;      // where there is one class alone: leaves are greener than this
constexpr float trunk_foot_share = 0.03f;    // of the height: where the trunk is looked for first
constexpr float search_radii = 1.7f;         // round the axis, in radii of the ring below
constexpr float min_filled = 0.35f;          // of a disc's area: less is no trunk
constexpr float max_widening = 1.06f;        // of a ring over the narrowest below
constexpr int lean_rings = 4;                // that predict where the next one is

/// The threshold between two classes by Otsu 1979; none where they are too alike.
std::optional<float> threshold_of(const TreeVolume& volume) {
  std::array<double, ratio_bins> counts{};
  double all = 0.0, sum = 0.0;
  const auto value_of = [](int bin) {
    return min_log_ratio + (double(bin) + 0.5) * (max_log_ratio - min_log_ratio) / ratio_bins;
  };
  for (std::size_t i = 0; i < volume.grid.size(); ++i) {
    const float at = (log_ratio(volume.colour[i]) - min_log_ratio) / (max_log_ratio - min_log_ratio);
    const int bin = std::clamp(int(at * ratio_bins), 0, ratio_bins - 1);
    counts[std::size_t(bin)] += volume.alpha(i), all += volume.alpha(i);
    sum += volume.alpha(i) * value_of(bin);
  }
  double below = 0.0, sum_below = 0.0, best = -1.0;
  std::optional<float> threshold;
  for (int bin = 0; bin + 1 < ratio_bins; ++bin) {
    below += counts[std::size_t(bin)], sum_below += counts[std::size_t(bin)] * value_of(bin);
    if (below <= 0.0 || all - below <= 0.0) continue;
    const double gap = (sum - sum_below) / (all - below) - sum_below / below;
    const double between = below * (all - below) * gap * gap;
    if (between <= best) continue;
    best = between;
    threshold = gap > double(min_separation) ? std::optional(float(value_of(bin))) : std::nullopt;
  }
  return threshold;
}

/// One layer of the grid: what is no leaf, as area from above.
struct Wood {
  glm::vec2 at;
  float area_m2;
};

std::map<int, std::vector<Wood>> wood_of_layers(const TreeVolume& volume, float leaf_threshold) {
  std::map<int, std::vector<Wood>> layers;
  const glm::vec3 size = volume.grid.cell_size_m();
  for (std::size_t i = 0; i < volume.grid.size(); ++i)
    if (log_ratio(volume.colour[i]) <= leaf_threshold)
      layers[volume.grid.cells()[i].z].push_back(
          {glm::vec2(volume.grid.centre(i)), volume.alpha(i) * size.x * size.y});
  return layers;
}

/// The disc of what lies within `reach_m` of `middle`.
Trunk::Ring disc_of(const std::vector<Wood>& layer, glm::vec2 middle, float reach_m) {
  glm::vec2 sum(0.0f);
  float area = 0.0f;
  for (const Wood& wood : layer)
    if (glm::distance(wood.at, middle) <= reach_m) sum += wood.area_m2 * wood.at, area += wood.area_m2;
  if (area <= 0.0f) return {glm::vec3(middle, 0.0f), 0.0f};
  return {glm::vec3(sum / area, 0.0f), std::sqrt(area / 3.14159265f)};
}

Trunk trunk_of(const TreeVolume& volume, float leaf_threshold) {
  Trunk trunk;
  const auto layers = wood_of_layers(volume, leaf_threshold);
  if (layers.empty()) return trunk;
  const glm::vec3 size = volume.grid.cell_size_m();
  const float cell_m = std::max(size.x, size.y);
  const int lowest = layers.begin()->first, highest = layers.rbegin()->first;
  const int foot = lowest + std::max(1, int(trunk_foot_share * float(highest - lowest)));
  float narrowest = 1e30f;
  for (const auto& [layer, wood] : layers) {
    if (layer < foot) continue;
    Trunk::Ring ring;
    if (trunk.rings.empty()) {
      ring = disc_of(wood, disc_of(wood, glm::vec2(0.0f), 1e30f).centre, 1e30f);
    } else {
      const std::size_t last = trunk.rings.size() - 1,
                        before = last - std::min(last, std::size_t(lean_rings));
      const glm::vec3 lean =
          last == before ? glm::vec3(0.0f)
                         : (trunk.rings[last].centre - trunk.rings[before].centre) / float(last - before);
      const glm::vec2 expected = glm::vec2(trunk.rings[last].centre + lean);
      const float reach = std::max(search_radii * trunk.rings[last].radius_m, 1.5f * cell_m);
      ring = disc_of(wood, disc_of(wood, expected, reach).centre, reach);
      if (ring.radius_m * ring.radius_m < min_filled * narrowest * narrowest) break;
    }
    if (ring.radius_m < 0.25f * cell_m) break;
    narrowest = std::min(narrowest, ring.radius_m);
    ring.radius_m = std::min(ring.radius_m, max_widening * narrowest);
    ring.centre.z = volume.grid.box().min.z + (float(layer) + 0.5f) * size.z;
    trunk.rings.push_back(ring);
  }
  if (trunk.rings.size() < 3) return {};
  Trunk::Ring ground = trunk.rings.front();
  ground.centre.z = volume.grid.box().min.z + float(lowest) * size.z;
  trunk.rings.insert(trunk.rings.begin(), ground);
  return trunk;
}

/// The trunk half a cell wider: a cell at its edge is partly of it.
Trunk with_edge(Trunk trunk, const TreeVolume& volume) {
  const glm::vec3 size = volume.grid.cell_size_m();
  for (Trunk::Ring& ring : trunk.rings) ring.radius_m += 0.5f * std::max(size.x, size.y);
  return trunk;
}

}  // namespace

float Organs::share(const TreeVolume& volume, Organ organ) const {
  double sum = 0.0, all = 1e-12;
  for (std::size_t i = 0; i < of_cell.size(); ++i) {
    all += double(volume.extinction_per_m[i]);
    if (of_cell[i] == organ) sum += double(volume.extinction_per_m[i]);
  }
  return float(sum / all);
}

Organs organs_of(const TreeVolume& volume) {
  Organs organs;
  organs.leaf_threshold = std::max(threshold_of(volume).value_or(leaf_log_ratio), min_leaf_log_ratio);
  organs.trunk = trunk_of(volume, organs.leaf_threshold);
  const Trunk trunk = with_edge(organs.trunk, volume);
  organs.of_cell.reserve(volume.grid.size());
  for (std::size_t i = 0; i < volume.grid.size(); ++i)
    organs.of_cell.push_back(trunk.contains(volume.grid.centre(i))                 ? Organ::trunk
                             : log_ratio(volume.colour[i]) > organs.leaf_threshold ? Organ::leaf
                                                                                   : Organ::branch);
  return organs;
}

TreeVolume without(const TreeVolume& volume, const Organs& organs, Organ organ) {
  TreeVolume result;
  std::vector<glm::u16vec3> cells;
  for (std::size_t i = 0; i < volume.grid.size(); ++i) {
    if (organs.of_cell[i] == organ) continue;
    cells.push_back(volume.grid.cells()[i]);
    result.extinction_per_m.push_back(volume.extinction_per_m[i]), result.colour.push_back(volume.colour[i]);
  }
  result.grid = CellGrid(volume.grid.box(), volume.grid.branching(), volume.grid.side(), std::move(cells));
  return result;
}

void erase_trunk(std::vector<TreeView>& views, const TreeVolume& volume, const Organs& organs) {
  const Trunk trunk = with_edge(organs.trunk, volume);
  if (trunk.rings.size() < 2) return;
  parallel_for(views.size(), [&](std::size_t i) {
    TreeView& view = views[i];
    const auto erase_disc = [&](const Trunk::Ring& ring) {
      const glm::vec3 seen = view.camera.project(ring.centre);
      if (seen.z <= 0.0f) return;
      const float radius = view.camera.focal.x * ring.radius_m / seen.z + 1.0f;
      const glm::ivec2 size(view.picture.width, view.picture.height);
      const glm::ivec2 low =
          glm::clamp(glm::ivec2(glm::floor(glm::vec2(seen) - radius)), glm::ivec2(0), size);
      const glm::ivec2 high =
          glm::clamp(glm::ivec2(glm::ceil(glm::vec2(seen) + radius)), glm::ivec2(0), size);
      for (int y = low.y; y < high.y; ++y)
        for (int x = low.x; x < high.x; ++x) {
          std::uint8_t* p = view.picture.at(x, y);
          if (p[3] == 0 || glm::distance(glm::vec2(float(x), float(y)) + 0.5f, glm::vec2(seen)) > radius)
            continue;
          const glm::vec3 colour =
              linear_from_srgb(glm::vec3(float(p[0]), float(p[1]), float(p[2])) / 255.0f);
          if (log_ratio(colour) <= organs.leaf_threshold) p[3] = 0;
        }
    };
    // Discs so close to each other that their outline is the trunk's.
    const float low = trunk.rings.front().centre.z, high = trunk.rings.back().centre.z;
    const int discs = 2 * std::max(view.picture.height, 1);
    for (int k = 0; k <= discs; ++k) erase_disc(trunk.ring_at(glm::mix(low, high, float(k) / float(discs))));
  });
}

Result<TrunkShape> trunk_shape(const Organs& organs, std::span<const TreeView> views) {
  if (organs.trunk.rings.size() < 2) return error("no trunk was found: its crown reaches the ground");
  return TrunkShape{organs.trunk, bark_texture(organs.trunk, views, organs.leaf_threshold)};
}

}  // namespace parvis::trees
