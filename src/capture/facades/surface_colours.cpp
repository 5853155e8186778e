#include "capture/facades/surface_colours.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"

namespace parvis::facades {
namespace {

constexpr std::size_t max_known_colours = 2000;  ///< that unknown surfaces are coloured from

/// Mean of the nearest known colours, weighted by distance; no_colour where none is known.
class NearestColours {
 public:
  /// Takes the triangles for which `counts` holds.
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
    if (weights <= 0.0) return no_colour;
    const glm::u8vec3 colour(glm::clamp(glm::round(sum / weights), 0.0, 255.0));
    return colour == no_colour ? colour + glm::u8vec3(0, 0, 1) : colour;
  }

 private:
  std::vector<glm::dvec3> points_, colours_;
};

/// Floors, ground and flat roofs, as against walls.
bool is_level(const LayerTriangle& triangle) {
  const auto& c = triangle.corners;
  const glm::dvec3 across = glm::cross(c[1] - c[0], c[2] - c[0]);
  constexpr double min_cosine = 0.7;  // of the angle between a level surface's normal and the vertical
  return std::abs(across.z) > min_cosine * glm::length(across);
}

/// The colours of kinds of surfaces, from which surfaces that are nowhere seen are coloured.
class ColoursOfKinds {
 public:
  ColoursOfKinds(const LayerModel& model, const TriangleColours& colours)
      : level_(model, colours, [&](const LayerTriangle& t) { return is_near(model, t) && is_level(t); }),
        upright_(model, colours, [&](const LayerTriangle& t) { return is_near(model, t) && !is_level(t); }),
        all_(model, colours, [](const LayerTriangle&) { return true; }) {}

  const NearestColours& of(const LayerTriangle& triangle) const {
    const NearestColours& kind = is_level(triangle) ? level_ : upright_;
    return kind.empty() ? all_ : kind;
  }

 private:
  /// No wall looks like the sky.
  static bool is_near(const LayerModel& model, const LayerTriangle& triangle) {
    return !model.objects[triangle.object].is_backdrop;
  }
  NearestColours level_, upright_, all_;
};

}  // namespace

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

std::vector<std::uint32_t> by_surface(const LayerModel& model) {
  std::vector<std::uint32_t> order(model.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t t) { return model.triangles[t].object; });
  return order;
}

void add_surfaces(const PlaceLayers& place, const TriangleColours& colours, PackedFacade& facade) {
  for (const LayerObject& object : place.model.objects) facade.surfaces.push_back(object.name);
  // A surface goes on as it is elsewhere: the lawn green, the sky bright; one that is nowhere seen as those
  // that lie as it does.
  const ColoursOfKinds of_kinds(place.model, colours);
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
        const bool is_refused = place.surfaces[triangle.object] == Filling::refused;
        const NearestColours& own = of_surface[triangle.object];
        const NearestColours& nearest = own.empty() ? of_kinds.of(triangle) : own;
        for (std::size_t k = 0; k < 3; ++k) {
          facade.corners[3 * i + k] = glm::vec3(triangle.corners[k]);
          facade.fallback[3 * i + k] = is_refused ? no_colour : nearest.at(triangle.corners[k]);
        }
      },
      64);
}

}  // namespace parvis::facades
