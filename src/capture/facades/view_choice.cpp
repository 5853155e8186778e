#include "capture/facades/view_choice.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "base/parallel.h"
#include "capture/facades/chosen_triangle.h"
#include "capture/facades/placed_facade.h"

namespace parvis::facades {
namespace {

constexpr std::size_t triangles_per_task = 512;
constexpr float step_share = 0.05f;  ///< of the distance from a photograph to the nearest other
constexpr float nearest_share = 0.3f,
                min_step_share = 0.1f;  ///< of the distance to the nearest one; of a step
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

/// The best layers at a point by their keys, the best first; the key of none is FacadeLookup::no_opinion.
using Best = std::array<std::pair<float, std::uint32_t>, best_count>;

/// Chooses for the triangles of a facade, one after the other.
class TriangleChooser {
 public:
  TriangleChooser(const PackedFacade& facade, const TileAlphas& alphas, const ChosenEye& eye,
                  std::span<const char> resident)
      : facade_(facade), lookup_(facade, nullptr, &alphas), eye_(eye), resident_(resident) {}

  /// Whether a photograph ends within the triangle, so that its centre does not speak for all of it.
  bool crosses_a_border(std::size_t triangle) const {
    const glm::uvec2 list = facade_.lists[triangle];
    for (std::uint32_t i = 0; i < list.y; ++i) {
      const View& view = facade_.photos[facade_.layers[facade_.candidates[list.x + i]].photo].view;
      int inside = 0;
      for (const glm::vec3& corner : corners_of(triangle)) {
        const glm::dvec3 p = view.to_camera(glm::dvec3(corner));
        const glm::dvec2 pixel = p.z > 0.0 ? view.to_pixel(p) : glm::dvec2(-1.0);
        inside += pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x <= view.width && pixel.y <= view.height;
      }
      if (inside != 0 && inside != 3) return true;
    }
    return false;
  }
  /// Its photographs and weights, where one choice serves all its pixels.
  std::optional<ChosenTriangle> one_choice(std::size_t triangle) {
    const Corners corners = corners_of(triangle);
    std::vector<std::uint32_t> layers;
    for (const auto& [key, layer] : best_at(triangle, (corners[0] + corners[1] + corners[2]) / 3.0f))
      if (key < FacadeLookup::no_opinion) layers.push_back(layer);
    if (layers.empty())
      for (const glm::vec3& corner : corners)
        if (best_at(triangle, corner)[0].first < FacadeLookup::no_opinion) return std::nullopt;
    return chosen_triangle(facade_, lookup_, triangle, eye_, layers);
  }

  /// The layers that it needs, appended to `chosen`; false where it needs its whole list.
  /// `is_even`: what its centre says holds for all of it, if it is small.
  bool append_best(std::size_t triangle, bool is_even, std::vector<std::uint32_t>& chosen) {
    const Corners corners = corners_of(triangle);
    const glm::vec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0f;
    float radius = 0.0f;
    for (const glm::vec3& corner : corners) radius = std::max(radius, glm::distance(corner, centre));
    const float angle = radius / std::max(glm::distance(centre, eye_.position), 1e-6f);
    if (angle > large_angle || facade_.lists[triangle].y <= best_count) return false;
    std::array<glm::vec3, 7> points;
    const std::size_t count = sample_points(corners, is_even && angle < small_angle, points),
                      first = chosen.size();
    for (std::size_t p = 0; p < count; ++p) {
      const Best best = best_at(triangle, points[p]);
      if (best[1].first >= FacadeLookup::no_opinion) return false;
      for (const auto& [key, layer] : best)
        if (key < FacadeLookup::no_opinion &&
            std::find(chosen.begin() + std::ptrdiff_t(first), chosen.end(), layer) == chosen.end())
          chosen.push_back(layer);
    }
    return chosen.size() - first <= max_chosen;
  }

 private:
  Corners corners_of(std::size_t triangle) const { return Corners(facade_.corners.data() + 3 * triangle, 3); }
  Best best_at(std::size_t triangle, glm::vec3 point) {
    const glm::vec3 off = eye_.position - point;
    const float distance = std::max(glm::length(off), 1e-6f);
    const glm::uvec2 list = facade_.lists[triangle];
    Best best;
    best.fill({FacadeLookup::no_opinion, 0});
    for (std::uint32_t i = 0; i < list.y; ++i) {
      const std::uint32_t layer = facade_.candidates[list.x + i];
      if (!resident_.empty() && !resident_[facade_.layers[layer].photo]) continue;
      std::pair<float, std::uint32_t> one(
          lookup_.key(layer, point, off / distance, eye_.pixel_angle * distance), layer);
      for (auto& entry : best)
        if (one.first < entry.first) std::swap(one, entry);
    }
    return best;
  }

  const PackedFacade& facade_;
  FacadeLookup lookup_;
  ChosenEye eye_;
  std::span<const char> resident_;
};

}  // namespace

ViewChooser::ViewChooser(const PackedFacade& facade)
    : facade_(facade),
      alphas_(facade),
      has_holes_(has_holes(facade)),
      step_(step_share * spacing_of(facade.photos)) {}

float ViewChooser::step(glm::vec3 eye) const {
  float nearest = std::numeric_limits<float>::max();
  for (const PackedPhoto& photo : facade_.photos)
    nearest = std::min(nearest, glm::distance(eye, glm::vec3(photo.view.centre)));
  return std::clamp(nearest_share * nearest, min_step_share * step_, step_);
}

ViewChoice ViewChooser::choice(glm::vec3 eye, float pixel_angle, std::span<const char> resident) const {
  ViewChoice choice{facade_.lists, {}, {}};
  if (!has_holes_) choice.triangles.resize(facade_.triangle_count());
  const std::size_t tasks = (facade_.triangle_count() + triangles_per_task - 1) / triangles_per_task;
  std::vector<std::vector<std::uint32_t>> parts(tasks);
  parallel_for(tasks, [&](std::size_t task) {
    TriangleChooser chooser(facade_, alphas_, {eye, pixel_angle}, resident);
    const std::size_t begin = task * triangles_per_task,
                      end = std::min(begin + triangles_per_task, facade_.triangle_count());
    std::vector<std::uint32_t>& part = parts[task];
    for (std::size_t t = begin; t < end; ++t) {
      const std::size_t first = part.size();
      const bool is_crossing = chooser.crosses_a_border(t);
      if (!has_holes_ && !is_crossing && (choice.triangles[t] = chooser.one_choice(t))) continue;
      if (chooser.append_best(t, !is_crossing, part))
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
