#include "land/roads/opposite_lanes.h"

#include <algorithm>
#include <cmath>

#include "scene/data/path.h"

namespace parvis::scene {
namespace {

constexpr float min_cell_m = 16.0f;
constexpr float max_aside = 0.3f;  // lane widths off the expected place

/// Whether a segment of a lane passes within `reach_m` of `place` against the direction `way`.
bool passes_against(const Lane& lane, std::size_t segment, glm::vec2 place, glm::vec2 direction,
                    float reach_m) {
  const glm::vec2 a(lane.points[segment]), along = glm::vec2(lane.points[segment + 1]) - a;
  const float fraction = std::clamp(glm::dot(place - a, along) / glm::dot(along, along), 0.0f, 1.0f);
  return glm::distance(a + fraction * along, place) < reach_m && glm::dot(along, direction) < 0.0f;
}

}  // namespace

OppositeLanes::OppositeLanes(const RoadGraph& roads) : cell_m_(min_cell_m) {
  for (const Lane& lane : roads.lanes) cell_m_ = std::max(cell_m_, 2.0f * lane.width_m);
  for (const Lane& lane : roads.lanes)
    for (std::size_t i = 0; lane.crossing < 0 && i + 1 < lane.points.size(); ++i) note(lane, i);
}

std::int64_t OppositeLanes::cell_of(glm::ivec2 cell) const {
  return (std::int64_t(cell.x) << 32) ^ std::int64_t(std::uint32_t(cell.y));
}

glm::ivec2 OppositeLanes::cell_at(glm::vec2 point) const { return glm::ivec2(glm::floor(point / cell_m_)); }

/// A segment is noted in the cells of its points at every half cell or nearer: so none of its points lies
/// further than a quarter of a cell from one that is noted.
void OppositeLanes::note(const Lane& lane, std::size_t segment) {
  const glm::vec2 a(lane.points[segment]), b(lane.points[segment + 1]);
  const int steps = std::max(1, int(std::ceil(2.0f * glm::distance(a, b) / cell_m_)));
  glm::ivec2 last(0);
  for (int i = 0; i <= steps; ++i) {
    const glm::ivec2 cell = cell_at(glm::mix(a, b, float(i) / float(steps)));
    if (i == 0 || cell != last) pieces_[cell_of(cell)].push_back({&lane, segment});
    last = cell;
  }
}

bool OppositeLanes::has(const Lane& lane) const {
  const MeasuredPath path(lane.points);
  const float middle_m = 0.5f * path.length();
  const glm::vec3 direction = path.direction_at(middle_m);
  const glm::vec2 expected(path.at(middle_m) - right_of(direction) * lane.width_m);
  const glm::ivec2 middle = cell_at(expected);
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      const auto found = pieces_.find(cell_of(middle + glm::ivec2(x, y)));
      if (found == pieces_.end()) continue;
      for (const Piece& piece : found->second)
        if (piece.lane != &lane && passes_against(*piece.lane, piece.segment, expected, glm::vec2(direction),
                                                  max_aside * lane.width_m))
          return true;
    }
  return false;
}

}  // namespace parvis::scene
