#include "planning/planner/snap.h"

#include <algorithm>
#include <cmath>

namespace parvis::planner {
namespace {

glm::dvec2 nearest_on(const PlanSegment& line, glm::dvec2 p) {
  const glm::dvec2 along = line[1] - line[0];
  const double length2 = glm::dot(along, along);
  if (length2 == 0.0) return line[0];
  return line[0] + std::clamp(glm::dot(p - line[0], along) / length2, 0.0, 1.0) * along;
}

std::optional<glm::dvec2> crossing_of(const PlanSegment& a, const PlanSegment& b) {
  const glm::dvec2 u = a[1] - a[0], v = b[1] - b[0], w = b[0] - a[0];
  const double area = u.x * v.y - u.y * v.x;
  if (std::abs(area) < 1e-9 * glm::length(u) * glm::length(v)) return std::nullopt;
  const double s = (w.x * v.y - w.y * v.x) / area, t = (w.x * u.y - w.y * u.x) / area;
  if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0) return std::nullopt;
  return a[0] + s * u;
}

/// Keeps the best candidate of one kind.
class Choice {
 public:
  Choice(glm::dvec2 wanted, double within_m) : wanted_(wanted), nearest_m_(within_m) {}

  void offer(glm::dvec2 at, SnapKind kind, std::vector<PlanSegment> guides) {
    const double distance_m = glm::distance(at, wanted_);
    if (distance_m >= nearest_m_) return;
    nearest_m_ = distance_m;
    chosen_ = {at, kind, std::move(guides)};
  }
  bool has_any() const { return chosen_.kind != SnapKind::none; }
  const Snapped& chosen() const { return chosen_; }

 private:
  glm::dvec2 wanted_;
  double nearest_m_;
  Snapped chosen_;
};

std::vector<PlanSegment> lines_near(const SnapTargets& targets, glm::dvec2 p, double within_m) {
  std::vector<PlanSegment> near;
  for (const PlanSegment& line : targets.lines)
    if (glm::distance(nearest_on(line, p), p) < within_m) near.push_back(line);
  return near;
}

/// Offers places in line with two others at their distance, or midway between them.
void offer_spacing(const SnapTargets& targets, Choice& choice) {
  constexpr std::size_t max_middles = 64;  // of those that stand nearest
  const std::vector<glm::dvec2>& middles = targets.middles;
  const std::size_t count = std::min(middles.size(), max_middles);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < count; ++k) {
      if (i == k) continue;
      const glm::dvec2 next = 2.0 * middles[k] - middles[i];
      choice.offer(next, SnapKind::spacing, {{middles[i], middles[k]}, {middles[k], next}});
      if (i < k) {
        const glm::dvec2 between = 0.5 * (middles[i] + middles[k]);
        choice.offer(between, SnapKind::spacing, {{middles[i], between}, {between, middles[k]}});
      }
    }
}

/// Level with another object along an axis of the plan.
void offer_alignment(glm::dvec2 wanted, const SnapTargets& targets, Choice& choice) {
  for (const glm::dvec2 middle : targets.middles)
    for (const glm::dvec2 at : {glm::dvec2(middle.x, wanted.y), glm::dvec2(wanted.x, middle.y)})
      choice.offer(at, SnapKind::line, {{middle, at}});
}

}  // namespace

const char* name_of(SnapKind kind) {
  constexpr std::array names{"free", "grid", "line", "even spacing", "right angle", "crossing", "end"};
  return names[std::size_t(kind)];
}

Snapped snap(glm::dvec2 wanted, const SnapTargets& targets, double within_m, bool keeps_right_angles) {
  if (keeps_right_angles && targets.origin) {
    const glm::dvec2 from = *targets.origin, away = wanted - from;
    const bool is_along_x = std::abs(away.x) >= std::abs(away.y);
    glm::dvec2 at = is_along_x ? glm::dvec2(wanted.x, from.y) : glm::dvec2(from.x, wanted.y);
    if (targets.grid_m > 0.0) {
      const int axis = is_along_x ? 0 : 1;
      at[axis] = std::round(at[axis] / targets.grid_m) * targets.grid_m;
    }
    return {at, SnapKind::right_angle, {{from, at}}};
  }
  Choice ends(wanted, within_m), crossings(wanted, within_m), angles(wanted, within_m),
      spacings(wanted, within_m), lines(wanted, within_m);
  for (const glm::dvec2 end : targets.ends) ends.offer(end, SnapKind::end, {});
  if (ends.has_any()) return ends.chosen();
  const std::vector<PlanSegment> near = lines_near(targets, wanted, within_m);
  for (std::size_t i = 0; i < near.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (const auto at = crossing_of(near[i], near[k]))
        crossings.offer(*at, SnapKind::crossing, {near[i], near[k]});
  if (crossings.has_any()) return crossings.chosen();
  if (targets.origin)
    for (const glm::dvec2 at :
         {glm::dvec2(wanted.x, targets.origin->y), glm::dvec2(targets.origin->x, wanted.y)})
      if (glm::distance(at, *targets.origin) > within_m)
        angles.offer(at, SnapKind::right_angle, {{*targets.origin, at}});
  if (angles.has_any()) return angles.chosen();
  offer_spacing(targets, spacings);
  if (spacings.has_any()) return spacings.chosen();
  offer_alignment(wanted, targets, lines);
  for (const PlanSegment& line : near) lines.offer(nearest_on(line, wanted), SnapKind::line, {line});
  if (lines.has_any()) return lines.chosen();
  if (targets.grid_m <= 0.0) return {wanted, SnapKind::none, {}};
  return {glm::round(wanted / targets.grid_m) * targets.grid_m, SnapKind::grid, {}};
}

}  // namespace parvis::planner
