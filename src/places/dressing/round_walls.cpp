#include "places/dressing/round_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

namespace parvis::dressing {
namespace {

constexpr std::size_t min_facets = 3;  // two are a corner
constexpr float max_facet_m = 6.0f;    // wider ones have rows of windows of their own
const float min_cos = std::cos(glm::radians(30.0f)), max_cos = std::cos(glm::radians(1.0f));
constexpr float same_run_height_m = 0.1f;  // of the feet and of the eaves of a run
constexpr float beside_m = 0.1f;           // overlap in height from which on a wall meets another one
constexpr std::size_t max_ends = 50;       // at one point: maps that heap more on it are wrong
constexpr float even = 0.05f;              // widths of facets that differ by a smaller fraction are the same

float width_of(const WallPanel& panel) { return panel.high.x - panel.low.x; }

/// An end of a panel, as a point of the plan.
struct PanelEnd {
  std::size_t panel;
  bool is_low;
};

/// The ends of panels by the points of the plan where corners of their triangles lie.
class PanelEnds {
 public:
  PanelEnds(const std::vector<WallPanel>& panels, const std::vector<ModelTriangle>& walls)
      : panels_(panels), points_(panels.size()) {
    for (std::size_t i = 0; i < panels.size(); ++i) {
      points_[i] = end_points(panels[i], walls);
      ends_[points_[i][0]].push_back({i, true}), ends_[points_[i][1]].push_back({i, false});
    }
  }

  /// The panel that begins where another one ends, if these two alone meet there.
  std::optional<std::size_t> only_neighbour(std::size_t panel) const {
    const std::vector<PanelEnd>& here = ends_.at(points_[panel][1]);
    if (here.size() > max_ends) return std::nullopt;
    std::optional<std::size_t> found;
    for (const PanelEnd& end : here) {
      if (end.panel == panel || !are_beside(panels_[panel], panels_[end.panel])) continue;
      if (found || !end.is_low) return std::nullopt;
      found = end.panel;
    }
    return found;
  }

 private:
  using Point = std::array<long, 2>;  // in steps of same_point_m

  /// Where the triangles of a panel begin and end along it.
  static std::array<Point, 2> end_points(const WallPanel& panel, const std::vector<ModelTriangle>& walls) {
    glm::vec2 first(0.0f), last(0.0f);
    float low = 1e30f, high = -1e30f;
    for (const std::size_t i : panel.triangles)
      for (const glm::vec3& corner : walls[i].corners) {
        const float place = glm::dot(corner, panel.along);
        if (place < low) low = place, first = glm::vec2(corner);
        if (place > high) high = place, last = glm::vec2(corner);
      }
    const auto rounded = [](glm::vec2 at) {
      return Point{std::lround(at.x / same_point_m), std::lround(at.y / same_point_m)};
    };
    return {rounded(first), rounded(last)};
  }

  static bool are_beside(const WallPanel& a, const WallPanel& b) {
    return std::min(a.high.y, b.high.y) - std::max(a.low.y, b.low.y) > beside_m;
  }

  const std::vector<WallPanel>& panels_;
  std::vector<std::array<Point, 2>> points_;
  std::map<Point, std::vector<PanelEnd>> ends_;
};

bool are_facets_of_a_curve(const WallPanel& a, const WallPanel& b) {
  const float cosine = glm::dot(a.normal, b.normal);
  return std::max(width_of(a), width_of(b)) <= max_facet_m && a.building == b.building && a.kind == b.kind &&
         a.stands_on_ground == b.stands_on_ground && std::abs(a.low.y - b.low.y) < same_run_height_m &&
         std::abs(a.eaves_m - b.eaves_m) < same_run_height_m && cosine >= min_cos && cosine <= max_cos;
}

/// The panels after a first one, which is among them, from facet to facet; all panels of a ring.
std::vector<std::size_t> followed(std::size_t first, const std::vector<std::optional<std::size_t>>& next) {
  std::vector<std::size_t> run{first};
  for (std::optional<std::size_t> at = next[first]; at && *at != first; at = next[*at]) run.push_back(*at);
  return run;
}

void set_run(std::vector<WallPanel>& panels, const std::vector<std::size_t>& run, bool is_ring) {
  WallRun common{.first = run.front(), .facets = int(run.size()), .is_ring = is_ring};
  const WallPanel& begin = panels[run.front()];
  common.place_m = begin.low.x + begin.offset_m;
  float foot_m = -1e30f, eaves_m = 1e30f, narrowest = 1e30f, widest = 0.0f;
  for (const std::size_t i : run) {
    const float width_m = width_of(panels[i]);
    common.length_m += width_m;
    narrowest = std::min(narrowest, width_m), widest = std::max(widest, width_m);
    foot_m = std::max(foot_m, panels[i].low.y), eaves_m = std::min(eaves_m, panels[i].eaves_m);
  }
  common.is_even = widest - narrowest < even * widest;
  const auto halfway = [&](std::size_t a, std::size_t b) {
    return glm::normalize(panels[a].normal + panels[b].normal);
  };
  for (std::size_t k = 0; k < run.size(); ++k) {
    WallPanel& panel = panels[run[k]];
    panel.low.y = foot_m, panel.eaves_m = eaves_m, panel.run = common;
    common.before_m += width_of(panel);
    const bool has_before = k > 0 || is_ring, has_after = k + 1 < run.size() || is_ring;
    const std::size_t before = run[(k + run.size() - 1) % run.size()], after = run[(k + 1) % run.size()];
    panel.run.first_normal = has_before ? halfway(before, run[k]) : panel.normal;
    panel.run.last_normal = has_after ? halfway(run[k], after) : panel.normal;
  }
}

}  // namespace

void find_runs(std::vector<WallPanel>& panels, const std::vector<ModelTriangle>& walls) {
  const PanelEnds ends(panels, walls);
  std::vector<std::optional<std::size_t>> next(panels.size());
  std::vector<bool> has_before(panels.size(), false), is_done(panels.size(), false);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const std::optional<std::size_t> other = ends.only_neighbour(i);
    if (!other || has_before[*other] || !are_facets_of_a_curve(panels[i], panels[*other])) continue;
    next[i] = other, has_before[*other] = true;
  }
  const auto begin_at = [&](std::size_t first, bool is_ring) {
    const std::vector<std::size_t> run = followed(first, next);
    for (const std::size_t i : run) is_done[i] = true;
    if (run.size() >= min_facets) return set_run(panels, run, is_ring);
    for (const std::size_t i : run) set_run(panels, {i}, false);
  };
  for (std::size_t i = 0; i < panels.size(); ++i)
    if (!has_before[i]) begin_at(i, false);
  for (std::size_t i = 0; i < panels.size(); ++i)
    if (!is_done[i]) begin_at(i, true);
}

RunBays bays_of(const WallRun& run, float bay_m) {
  const RunBays usual{std::max(1.0f, std::round(run.length_m / bay_m)), 0.0f};
  if (run.facets == 1 || !run.is_even) return usual;
  const float facet_m = run.length_m / float(run.facets);
  if (facet_m > bay_m) return {std::round(facet_m / bay_m) * float(run.facets), 0.0f};
  const int in_each = int(std::lround(bay_m / facet_m));  // facets in a bay
  if (run.facets % in_each != 0) return usual;
  // The middle of a bay of two facets is the edge between them.
  const bool shifts = run.is_ring && in_each % 2 == 0;
  const int bays = run.facets / in_each;
  return {float(bays), shifts ? 0.5f / float(in_each) : 0.0f};
}

}  // namespace parvis::dressing
