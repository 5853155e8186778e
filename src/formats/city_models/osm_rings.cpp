#include "formats/city_models/osm_rings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "formats/city_models/osm_areas.h"
#include "formats/city_models/osm_segments.h"

namespace parvis::scene {
namespace {

using glm::dvec2;

bool is_before(dvec2 a, dvec2 b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); }

bool visits_points_once(OsmRing ring) {
  std::ranges::sort(ring, is_before);
  return std::ranges::adjacent_find(ring) == ring.end();
}

struct Side {
  std::size_t from, to;  ///< points
  bool is_inner;
};

/// A ring by its points, and whether all its sides are of inner lines.
struct SimpleRing {
  OsmRing ring;
  bool is_inner;
};

/// The sides of all lines, each once, between points of which each is there once.
class Borders {
 public:
  explicit Borders(const std::vector<OsmClosedLine>& lines) {
    std::vector<Side> sides;
    for (const OsmClosedLine& line : lines)
      for (std::size_t i = 0; i < line.ring.size(); ++i)
        sides.push_back(
            {index_of(line.ring[i]), index_of(line.ring[(i + 1) % line.ring.size()]), line.is_inner});
    if (lines.size() > 1) sides = split(sides);
    keep_odd(sides);
  }

  /// Rings that visit no point twice and do not cross where they touch.
  std::vector<SimpleRing> rings() const {
    const std::vector<std::size_t> next = sides_that_follow();
    std::vector<bool> is_taken(sides_.size(), false);
    std::vector<SimpleRing> found;
    for (std::size_t first = 0; first < sides_.size(); ++first) {
      if (is_taken[first]) continue;
      std::vector<Step> trail;
      std::size_t end = 2 * first;  // of a side: 2 i where it begins, 2 i + 1 where it ends
      do {
        const Side& side = sides_[end / 2];
        is_taken[end / 2] = true;
        trail.push_back({end % 2 == 0 ? side.to : side.from, side.is_inner});
        end = next[end ^ 1u];
      } while (end / 2 != first);
      add_simple(trail, found);
    }
    return found;
  }

 private:
  /// A step of a walk along sides: a point, and the side that led to it.
  struct Step {
    std::size_t point;
    bool is_inner;
  };

  std::size_t index_of(dvec2 point) {
    const auto [found, is_new] = indices_.try_emplace({point.x, point.y}, points_.size());
    if (is_new) points_.push_back(point);
    return found->second;
  }

  /// Splits the sides at the points that lie on them.
  std::vector<Side> split(const std::vector<Side>& sides) const {
    OsmSegments<std::size_t> near;
    for (std::size_t i = 0; i < sides.size(); ++i) near.add(points_[sides[i].from], points_[sides[i].to], i);
    std::vector<std::set<std::pair<double, std::size_t>>> on(sides.size());  // by the place along the side
    for (std::size_t point = 0; point < points_.size(); ++point)
      near.each_near(points_[point], points_[point], [&](const auto& segment) {
        const Side& side = sides[segment.owner];
        if (point == side.from || point == side.to) return true;
        const dvec2 along = segment.b - segment.a, from = points_[point] - segment.a;
        const double at = glm::dot(from, along) / glm::dot(along, along);
        if (at > 0.0 && at < 1.0 && glm::distance(from, at * along) < same_place_m)
          on[segment.owner].emplace(at, point);
        return true;
      });
    std::vector<Side> pieces;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      std::size_t from = sides[i].from;
      for (const auto& [at, point] : on[i])
        pieces.push_back({std::exchange(from, point), point, sides[i].is_inner});
      pieces.push_back({from, sides[i].to, sides[i].is_inner});
    }
    return pieces;
  }

  /// Keeps the sides that occur an odd number of times: a side that two lines have in common is no border.
  void keep_odd(const std::vector<Side>& sides) {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> count;
    const auto key = [](const Side& side) { return std::minmax(side.from, side.to); };
    for (const Side& side : sides) ++count[key(side)];
    for (const Side& side : sides) {
      std::size_t& left = count[key(side)];
      if (left % 2 == 1 && side.from != side.to) sides_.push_back(side);
      left = 0;
    }
  }

  /// Joins each end of a side to the end of another at the same point: neighbours by their angles, so that
  /// rings touch where more than two sides meet, and do not cross.
  std::vector<std::size_t> sides_that_follow() const {
    std::vector<std::vector<std::pair<double, std::size_t>>> ends(points_.size());
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const dvec2 along = points_[sides_[i].to] - points_[sides_[i].from];
      ends[sides_[i].from].emplace_back(std::atan2(along.y, along.x), 2 * i);
      ends[sides_[i].to].emplace_back(std::atan2(-along.y, -along.x), 2 * i + 1);
    }
    std::vector<std::size_t> next(2 * sides_.size());
    for (auto& here : ends) {
      std::ranges::sort(here);
      for (std::size_t i = 0; i + 1 < here.size(); i += 2) {
        next[here[i].second] = here[i + 1].second;
        next[here[i + 1].second] = here[i].second;
      }
    }
    return next;
  }

  /// A closed walk as rings: whenever it comes back to a point, a ring ends there.
  void add_simple(const std::vector<Step>& trail, std::vector<SimpleRing>& found) const {
    std::vector<Step> open;
    std::map<std::size_t, std::size_t> place_of;  // of points in `open`
    const auto close = [&](std::size_t first, bool is_inner) {
      SimpleRing& ring = found.emplace_back(SimpleRing{{}, is_inner});
      for (std::size_t i = first; i < open.size(); ++i) {
        ring.ring.push_back(points_[open[i].point]);
        if (i > first) ring.is_inner = ring.is_inner && open[i].is_inner;
      }
    };
    for (const Step& step : trail) {
      const auto [place, is_new] = place_of.try_emplace(step.point, open.size());
      if (is_new) {
        open.push_back(step);
        continue;
      }
      const std::size_t first = place->second;
      close(first, step.is_inner);
      for (std::size_t i = first + 1; i < open.size(); ++i) place_of.erase(open[i].point);
      open.resize(first + 1);
    }
    if (open.size() > 1) close(0, open.front().is_inner);
  }

  std::map<std::pair<double, double>, std::size_t> indices_;
  std::vector<dvec2> points_;
  std::vector<Side> sides_;
};

/// A ring among others.
struct Placed {
  double area_m2;
  dvec2 low, high;
  std::size_t depth = 0;                   ///< how many rings it lies in
  std::optional<std::size_t> around = {};  ///< the smallest of them
};

/// Whether most of a ring's sides lie in another, which it may touch.
bool lies_in(const OsmRing& ring, const OsmRing& other) {
  constexpr std::size_t asked = 7;
  std::size_t inside = 0;
  const std::size_t count = std::min(asked, ring.size());
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = k * ring.size() / count;
    if (holds(other, 0.5 * (ring[i] + ring[(i + 1) % ring.size()]))) ++inside;
  }
  return 2 * inside > count;
}

std::vector<Placed> nested(const std::vector<SimpleRing>& rings) {
  std::vector<Placed> placed;
  placed.reserve(rings.size());
  for (const SimpleRing& each : rings) {
    const auto [low, high] = box_of(each.ring);
    placed.push_back({std::abs(area_m2(each.ring)), low, high});
  }
  for (std::size_t i = 0; i < rings.size(); ++i)
    for (std::size_t k = 0; k < rings.size(); ++k) {
      const bool may_hold = placed[k].area_m2 > placed[i].area_m2 &&
                            glm::all(glm::lessThan(placed[k].low - same_place_m, placed[i].low)) &&
                            glm::all(glm::greaterThan(placed[k].high + same_place_m, placed[i].high));
      if (i == k || !may_hold || !lies_in(rings[i].ring, rings[k].ring)) continue;
      ++placed[i].depth;
      if (!placed[i].around || placed[k].area_m2 < placed[*placed[i].around].area_m2) placed[i].around = k;
    }
  return placed;
}

}  // namespace

std::vector<std::vector<OsmRing>> nested_rings(const std::vector<OsmClosedLine>& lines, std::size_t& lost) {
  std::vector<SimpleRing> rings;
  if (lines.size() == 1 && visits_points_once(lines.front().ring))
    rings.push_back({lines.front().ring, lines.front().is_inner});
  else
    rings = Borders(lines).rings();
  std::erase_if(rings, [](const SimpleRing& each) { return each.ring.size() < 3; });
  const std::vector<Placed> placed = nested(rings);
  std::vector<std::vector<OsmRing>> areas;
  std::map<std::size_t, std::size_t> area_of;  // by outline
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (placed[i].depth % 2 != 0) continue;
    if (placed[i].depth == 0 && rings[i].is_inner) {
      ++lost;
      continue;
    }
    if (area_m2(rings[i].ring) < 0.0) std::ranges::reverse(rings[i].ring);
    area_of[i] = areas.size();
    areas.push_back({rings[i].ring});
  }
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const auto area = placed[i].depth % 2 != 0 ? area_of.find(*placed[i].around) : area_of.end();
    if (area == area_of.end()) continue;
    if (area_m2(rings[i].ring) > 0.0) std::ranges::reverse(rings[i].ring);
    areas[area->second].push_back(std::move(rings[i].ring));
  }
  return areas;
}

}  // namespace parvis::scene
