#include "capture/facades/view_choice.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "base/parallel.h"
#include "capture/facades/facade_lookup.h"

namespace parvis::facades {
namespace {

constexpr std::size_t triangles_per_task = 512;
constexpr float step_share = 0.05f;  ///< of the distance from a photograph to the nearest other
// Angle under which a triangle is seen, radians.
constexpr float small_angle = 0.04f;               ///< below it its centre stands for all of it
constexpr float large_angle = 0.5f;                ///< above it any photograph may be the best somewhere
constexpr std::uint32_t is_chosen_bit = 1u << 31;  ///< of a list's length while tasks are put together
constexpr std::size_t best_count = 3;  ///< two that are shown, and the one that says how far they fade

/// Mean distance from a photograph to the nearest other.
float spacing_of(std::span<const PackedPhoto> photos) {
  double sum = 0.0;
  for (const PackedPhoto& photo : photos) {
    double nearest = std::numeric_limits<double>::max();
    for (const PackedPhoto& other : photos)
      if (&other != &photo) nearest = std::min(nearest, glm::distance(photo.view.centre, other.view.centre));
    if (photos.size() > 1) sum += nearest / double(photos.size());
  }
  return float(sum);
}

using Corners = std::span<const glm::vec3, 3>;

/// Where a triangle is asked: its centre, and if it is not small corners and middles of edges, a little
/// inside.
std::size_t sample_points(Corners c, bool is_small, std::array<glm::vec3, 7>& points) {
  const glm::vec3 centre = (c[0] + c[1] + c[2]) / 3.0f;
  points[0] = centre;
  if (is_small) return 1;
  for (std::size_t k = 0; k < 3; ++k) {
    points[1 + k] = glm::mix(c[k], centre, 0.1f);
    points[4 + k] = glm::mix(0.5f * (c[k] + c[(k + 1) % 3]), centre, 0.1f);
  }
  return points.size();
}

/// The layers that a triangle needs, appended to `chosen`; false where it needs its whole list.
bool append_best(const PackedFacade& facade, FacadeLookup& lookup, std::size_t triangle, glm::vec3 eye,
                 float pixel_angle, std::span<const char> resident, std::vector<std::uint32_t>& chosen) {
  const Corners corners(facade.corners.data() + 3 * triangle, 3);
  const glm::uvec2 list = facade.lists[triangle];
  const glm::vec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0f;
  float radius = 0.0f;
  for (const glm::vec3& corner : corners) radius = std::max(radius, glm::distance(corner, centre));
  const float angle = radius / std::max(glm::distance(centre, eye), 1e-6f);
  if (angle > large_angle || list.y <= best_count) return false;
  std::array<glm::vec3, 7> points;
  const std::size_t count = sample_points(corners, angle < small_angle, points), first = chosen.size();
  for (std::size_t p = 0; p < count; ++p) {
    const glm::vec3 off = eye - points[p];
    const float distance = std::max(glm::length(off), 1e-6f);
    std::array<std::pair<float, std::uint32_t>, best_count> best;
    best.fill({FacadeLookup::no_opinion, 0});
    for (std::uint32_t i = 0; i < list.y; ++i) {
      const std::uint32_t layer = facade.candidates[list.x + i];
      if (!resident.empty() && !resident[facade.layers[layer].photo]) continue;
      std::pair<float, std::uint32_t> one(
          lookup.key(layer, points[p], off / distance, pixel_angle * distance), layer);
      for (auto& entry : best)
        if (one.first < entry.first) std::swap(one, entry);
    }
    if (best[1].first >= FacadeLookup::no_opinion) return false;
    for (const auto& [key, layer] : best)
      if (key < FacadeLookup::no_opinion &&
          std::find(chosen.begin() + std::ptrdiff_t(first), chosen.end(), layer) == chosen.end())
        chosen.push_back(layer);
  }
  return chosen.size() - first <= max_chosen;
}

}  // namespace

ViewChooser::ViewChooser(const PackedFacade& facade)
    : facade_(facade), step_(step_share * spacing_of(facade.photos)) {}

ViewChoice ViewChooser::choice(glm::vec3 eye, float pixel_angle, std::span<const char> resident) const {
  ViewChoice choice{facade_.lists, {}};
  const std::size_t tasks = (facade_.triangle_count() + triangles_per_task - 1) / triangles_per_task;
  std::vector<std::vector<std::uint32_t>> parts(tasks);
  parallel_for(tasks, [&](std::size_t task) {
    FacadeLookup lookup(facade_, nullptr);
    const std::size_t begin = task * triangles_per_task,
                      end = std::min(begin + triangles_per_task, facade_.triangle_count());
    std::vector<std::uint32_t>& part = parts[task];
    for (std::size_t t = begin; t < end; ++t) {
      const std::size_t first = part.size();
      if (append_best(facade_, lookup, t, eye, pixel_angle, resident, part))
        choice.lists[t] = {std::uint32_t(first), std::uint32_t(part.size() - first) | is_chosen_bit};
      else
        part.resize(first);
    }
  });
  for (std::size_t task = 0; task < tasks; ++task) {
    const std::uint32_t base = std::uint32_t(facade_.candidates.size() + choice.candidates.size());
    for (std::size_t t = task * triangles_per_task;
         t < std::min((task + 1) * triangles_per_task, facade_.triangle_count()); ++t)
      if (glm::uvec2& list = choice.lists[t]; (list.y & is_chosen_bit) != 0)
        list.x += base, list.y &= ~is_chosen_bit;
    choice.candidates.insert(choice.candidates.end(), parts[task].begin(), parts[task].end());
  }
  return choice;
}

}  // namespace parvis::facades
