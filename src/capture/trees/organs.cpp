#include "capture/trees/organs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "base/colour.h"
#include "base/parallel.h"

namespace parvis::trees {
namespace {

constexpr float min_log_ratio = -0.8f, max_log_ratio = 0.8f;  // of green over red, of the histogram
constexpr int ratio_bins = 128;
constexpr float min_separation = 0.16f;      // of the two classes' means: below it the tree is of one kind
constexpr float min_leaf_log_ratio = 0.08f;  // bark that the sky lights is bluish, but not greener than this
constexpr float leaf_log_ratio = 0.12f;      // where there is one class alone: leaves are greener than this
constexpr float foot_share = 0.03f;          // of the height: where the trunk is looked for first
constexpr float search_radii = 1.7f;         // round the axis, in radii of the ring below
constexpr float min_filled = 0.35f;          // of a disc's area: less is no trunk
constexpr float max_widening = 1.06f;        // of a ring over the narrowest below
constexpr int lean_rings = 4;                // that predict where the next one is
constexpr int texture_width = 256, texels_per_ring = 8, max_texture_height = 2048;
constexpr int min_wood_alpha = 250;  // of a pixel that shows no background
constexpr float min_cosine = 0.2f;   // between the bark's normal and the direction to a camera

float log_ratio(glm::vec3 colour) { return std::log((colour.y + 0.004f) / (colour.x + 0.004f)); }

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
  const int foot = lowest + std::max(1, int(foot_share * float(highest - lowest)));
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

/// What the photographs show of a point of the bark: linear light; alpha 0 where none sees it.
glm::vec4 bark_at(glm::vec3 point, glm::vec3 normal, std::span<const TreeView> views) {
  glm::vec4 sum(0.0f);
  for (const TreeView& view : views) {
    const float cosine = glm::dot(normal, glm::normalize(view.camera.position_in_world - point));
    if (cosine < min_cosine) continue;
    const glm::vec3 seen = view.camera.project(point);
    const glm::ivec2 pixel(glm::floor(glm::vec2(seen)));
    if (seen.z <= 0.0f || pixel.x < 0 || pixel.y < 0 || pixel.x >= view.picture.width ||
        pixel.y >= view.picture.height)
      continue;
    const std::uint8_t* p = view.picture.at(pixel.x, pixel.y);
    if (p[3] < min_wood_alpha) continue;
    // So that the most direct view dominates without an edge where another takes over.
    const float weight = std::pow(cosine, 16.0f);
    sum +=
        weight * glm::vec4(linear_from_srgb(glm::vec3(float(p[0]), float(p[1]), float(p[2])) / 255.0f), 1.0f);
  }
  return sum.w > 1e-6f ? glm::vec4(glm::vec3(sum) / sum.w, 1.0f) : glm::vec4(0.0f);
}

Image8 bark_texture(const Trunk& trunk, std::span<const TreeView> views) {
  const int height = std::min(max_texture_height, texels_per_ring * int(trunk.rings.size()));
  Image8 picture(texture_width, height, 4, 255);
  const float low = trunk.rings.front().centre.z, high = trunk.rings.back().centre.z;
  std::vector<glm::vec4> texels(std::size_t(texture_width) * std::size_t(height));
  parallel_for(std::size_t(height), [&](std::size_t row) {
    const Trunk::Ring ring = trunk.ring_at(glm::mix(high, low, (float(row) + 0.5f) / float(height)));
    for (int x = 0; x < texture_width; ++x) {
      const float turn = 6.2831853f * (float(x) + 0.5f) / texture_width;
      const glm::vec3 normal(std::cos(turn), std::sin(turn), 0.0f);
      texels[row * texture_width + std::size_t(x)] =
          bark_at(ring.centre + ring.radius_m * normal, normal, views);
    }
  });
  glm::vec4 mean(0.0f);
  for (const glm::vec4& texel : texels) mean += texel;
  const glm::vec3 unseen = mean.w > 0.0f ? glm::vec3(mean) / mean.w : glm::vec3(0.1f);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const glm::vec3 srgb = srgb_from_linear(texels[i].w > 0.0f ? glm::vec3(texels[i]) : unseen);
    for (int c = 0; c < 3; ++c)
      picture.pixels[4 * i + std::size_t(c)] = std::uint8_t(std::lround(255.0f * srgb[c]));
  }
  return picture;
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
  const glm::vec3 size = volume.grid.cell_size_m();
  Trunk with_edge = organs.trunk;  // a cell at the trunk's edge is partly of it
  for (Trunk::Ring& ring : with_edge.rings) ring.radius_m += 0.5f * std::max(size.x, size.y);
  organs.of_cell.reserve(volume.grid.size());
  for (std::size_t i = 0; i < volume.grid.size(); ++i)
    organs.of_cell.push_back(with_edge.contains(volume.grid.centre(i))             ? Organ::trunk
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

Result<TrunkShape> trunk_shape(const Trunk& trunk, std::span<const TreeView> views) {
  if (trunk.rings.size() < 2) return error("no trunk was found: its crown reaches the ground");
  return TrunkShape{trunk, bark_texture(trunk, views)};
}

}  // namespace parvis::trees
