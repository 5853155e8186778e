#include "formats/city_models/osm_corners.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "formats/city_models/straight_skeleton.h"

namespace parvis::scene {
namespace {

using glm::dvec2;

constexpr double same_m = 0.02;   // points that are nearer are one
constexpr double aside_m = 0.05;  // points that are nearer to a side lie along it

/// Whether b is the tip of a spike: the sides a b and b c run back along each other.
bool is_spike(dvec2 a, dvec2 b, dvec2 c) {
  const dvec2 in = b - a, out = c - b;
  const double shorter_m = std::min(glm::length(in), glm::length(out));
  return glm::dot(in, out) < 0.0 &&
         std::abs(cross_in_plan(in, out)) * shorter_m <= same_m * glm::length(in) * glm::length(out);
}

/// Every point farther than `same_m` from the one before.
OsmRing without_repeated(const OsmRing& ring) {
  OsmRing kept{ring.front()};
  for (const dvec2& point : ring)
    if (!(glm::distance(kept.back(), point) <= same_m)) kept.push_back(point);
  while (kept.size() > 1 && glm::distance(kept.back(), kept.front()) <= same_m) kept.pop_back();
  return kept;
}

/// Leaving the tip of a spike out may make a tip of the point before, which is looked at again, and bring the
/// points beside it together.
OsmRing without_spikes(const OsmRing& ring) {
  const std::size_t count = ring.size();
  std::vector<std::size_t> before(count), after(count);
  for (std::size_t i = 0; i < count; ++i) before[i] = (i + count - 1) % count, after[i] = (i + 1) % count;
  std::size_t left = count, at = 0;
  const auto leave_out = [&](std::size_t i) {
    after[before[i]] = after[i], before[after[i]] = before[i];
    --left;
  };
  for (std::size_t unchanged = 0; unchanged < left && left >= 3;) {
    const std::size_t last = before[at];
    if (!is_spike(ring[last], ring[at], ring[after[at]])) {
      at = after[at], ++unchanged;
      continue;
    }
    leave_out(at);
    while (left > 1 && glm::distance(ring[last], ring[after[last]]) <= same_m) leave_out(after[last]);
    at = last, unchanged = 0;
  }
  OsmRing kept;
  for (std::size_t i = 0; i < left; ++i, at = after[at]) kept.push_back(ring[at]);
  return kept;
}

/// The directions in which a side may leave a point and pass all points of a run within `aside_m`.
class Fan {
 public:
  explicit Fan(dvec2 from) : from_(from) {}

  /// Whether a side may end at the point: all points of the run lie along it.
  bool holds(dvec2 point) const {
    const dvec2 offset = point - from_;
    if (glm::length(offset) < reach_m_) return false;  // it runs back
    return !is_narrow_ || std::abs(angle_to(offset)) <= half_angle_;
  }
  /// Adds a point that a side, which ends farther on, must pass.
  void narrow(dvec2 point) {
    const dvec2 offset = point - from_;
    const double distance_m = glm::length(offset);
    reach_m_ = std::max(reach_m_, distance_m);
    if (distance_m <= aside_m) return;
    const double half_angle = std::asin(aside_m / distance_m);
    if (!is_narrow_) {
      is_narrow_ = true, middle_ = offset / distance_m, half_angle_ = half_angle;
      return;
    }
    const double turn = angle_to(offset), least = std::max(turn - half_angle, -half_angle_),
                 greatest = std::min(turn + half_angle, half_angle_);
    const double by = 0.5 * (least + greatest);
    middle_ = {std::cos(by) * middle_.x - std::sin(by) * middle_.y,
               std::sin(by) * middle_.x + std::cos(by) * middle_.y};
    half_angle_ = 0.5 * (greatest - least);
  }

 private:
  double angle_to(dvec2 offset) const {
    return std::atan2(cross_in_plan(middle_, offset), glm::dot(middle_, offset));
  }

  dvec2 from_, middle_{1.0, 0.0};
  double half_angle_ = std::numbers::pi, reach_m_ = 0.0;
  bool is_narrow_ = false;
};

/// A corner that no side passes: the farthest from the middle.
std::size_t outermost(const OsmRing& ring) {
  const dvec2 centre = middle(ring);
  std::size_t found = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (glm::distance(ring[i], centre) > glm::distance(ring[found], centre)) found = i;
  return found;
}

}  // namespace

OsmRing corners_of(const OsmRing& ring) {
  if (ring.size() < 3) return ring;
  const OsmRing drawn = without_spikes(without_repeated(ring));
  if (drawn.size() < 3) return ring;
  const std::size_t first = outermost(drawn);
  OsmRing corners{drawn[first]};
  Fan fan(drawn[first]);
  for (std::size_t i = 1; i <= drawn.size(); ++i) {
    const dvec2 last = drawn[(first + i - 1) % drawn.size()], next = drawn[(first + i) % drawn.size()];
    if (i > 1) fan.narrow(last);
    if (fan.holds(next)) continue;
    corners.push_back(last);
    fan = Fan(last);
  }
  return corners.size() >= 3 ? corners : ring;
}

}  // namespace parvis::scene
