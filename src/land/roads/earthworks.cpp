#include "land/roads/earthworks.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parvis::scene {
namespace {

constexpr float earthwork_cell_m = 20.0f;
constexpr float farthest_earthwork_cell = 1e8f;  // meshes may reach farther than cells have numbers
// At the ends of a road: on so much more to either side a car turns round, along so much of the road, over
// the same length again the bed narrows.
constexpr float turning_m = 3.0f, turning_length_m = 10.0f;
// Weight of a bed: one over a power of the distance from it in half widths. On the middle of one road another
// that crosses it counts for little; where their edges meet, both count alike.
constexpr float weight_offset = 0.6f;
constexpr float run_out_m = 0.5f * Earthworks::reach_m;

std::uint64_t key(glm::ivec2 cell) {
  return std::uint64_t(std::uint32_t(cell.x)) << 32u | std::uint32_t(cell.y);
}

glm::ivec2 earthwork_cell_of(glm::vec2 point) {
  return glm::ivec2(
      glm::clamp(glm::floor(point / earthwork_cell_m), -farthest_earthwork_cell, farthest_earthwork_cell));
}

/// How much wider a bed is to either side, so far from the nearer end of its road.
float widening_m(float to_end_m) {
  return turning_m * std::clamp(2.0f - to_end_m / turning_length_m, 0.0f, 1.0f);
}

/// How far the ground may lie off a bed, so far beside it: without bound where the works end.
float off_m(float beside_m) {
  const float left = std::clamp((Earthworks::reach_m - beside_m) / run_out_m, 0.0f, 1.0f);
  return Earthworks::slope * beside_m + 1.0f / left - 1.0f;
}

/// The bed of all roads that lie on the ground around a point.
struct Blend {
  float heights_m = 0.0f, weights = 0.0f;
  float beside_m = std::numeric_limits<float>::max();  ///< beside the nearest bed

  void add(float distance_m, float half_m, float height_m) {
    const float taper = 1.0f - distance_m / (half_m + Earthworks::reach_m);
    if (taper <= 0.0f) return;
    const float away = distance_m / half_m + weight_offset;
    const float weight = taper / (away * away * away);
    heights_m += weight * height_m, weights += weight;
    widen(distance_m, half_m);
  }
  /// Slopes begin beyond this bed, too, whatever its height.
  void widen(float distance_m, float half_m) {
    beside_m = std::min(beside_m, std::max(distance_m - half_m, 0.0f));
  }
  float shaped(float bare_m) const {
    if (weights <= 0.0f) return bare_m;
    const float bed_m = heights_m / weights, max_off_m = off_m(beside_m);
    return std::clamp(bare_m, bed_m - max_off_m, bed_m + max_off_m);
  }
};

}  // namespace

Earthworks::Earthworks(std::span<const RoadBed> beds) {
  for (std::size_t road = 0; road < beds.size(); ++road) add(beds[road], std::uint32_t(road));
}

void Earthworks::add(const RoadBed& bed, std::uint32_t road) {
  std::vector<float> along_m{0.0f};
  for (std::size_t i = 0; i + 1 < bed.points.size(); ++i)
    along_m.push_back(along_m.back() + glm::distance(glm::vec2(bed.points[i].position),
                                                     glm::vec2(bed.points[i + 1].position)));
  const auto half_at = [&](std::size_t i) {
    return bed.half_m + (bed.is_turn ? 0.0f : widening_m(std::min(along_m[i], along_m.back() - along_m[i])));
  };
  for (std::size_t i = 0; i + 1 < bed.points.size(); ++i) {
    const RoadBed::Point &a = bed.points[i], &b = bed.points[i + 1];
    const Bed kind = std::min(a.kind, b.kind);
    if (kind == Bed::none) continue;
    const auto index = std::uint32_t(pieces_.size());
    pieces_.push_back({a.position, b.position, half_at(i), half_at(i + 1), road, kind, bed.is_turn});
    const float around_m = bed.half_m + turning_m + reach_m;
    const glm::ivec2 low = earthwork_cell_of(glm::vec2(glm::min(a.position, b.position)) - around_m),
                     high = earthwork_cell_of(glm::vec2(glm::max(a.position, b.position)) + around_m);
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) cells_[key({x, y})].push_back(index);
  }
}

const std::vector<std::uint32_t>* Earthworks::near(glm::vec2 point) const {
  const auto cell = cells_.find(key(earthwork_cell_of(point)));
  return cell == cells_.end() ? nullptr : &cell->second;
}

Earthworks::Nearest Earthworks::nearest_on(const Piece& piece, glm::vec2 point) {
  const glm::vec2 along = glm::vec2(piece.b - piece.a), away = point - glm::vec2(piece.a);
  const float square = glm::dot(along, along);
  const float fraction = square > 0.0f ? std::clamp(glm::dot(away, along) / square, 0.0f, 1.0f) : 0.0f;
  return {glm::distance(away, fraction * along), glm::mix(piece.half_at_a_m, piece.half_at_b_m, fraction),
          glm::mix(piece.a.z, piece.b.z, fraction), piece.kind};
}

float Earthworks::at(glm::vec2 point, float bare_m) const {
  const std::vector<std::uint32_t>* const pieces = near(point);
  if (pieces == nullptr) return bare_m;
  Blend blend;
  float highest_m = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < pieces->size();) {
    const std::uint32_t road = pieces_[(*pieces)[i]].road;
    const bool is_turn = pieces_[(*pieces)[i]].is_turn;
    Nearest nearest{std::numeric_limits<float>::max(), 0.0f, 0.0f, Bed::none};
    for (; i < pieces->size() && pieces_[(*pieces)[i]].road == road; ++i)
      if (const Nearest here = nearest_on(pieces_[(*pieces)[i]], point); here.distance_m < nearest.distance_m)
        nearest = here;
    if (nearest.kind == Bed::earth && is_turn)
      blend.widen(nearest.distance_m, nearest.half_m);
    else if (nearest.kind == Bed::earth)
      blend.add(nearest.distance_m, nearest.half_m, nearest.height_m);
    else if (!is_turn)
      highest_m =
          std::min(highest_m, nearest.height_m + off_m(std::max(nearest.distance_m - nearest.half_m, 0.0f)));
  }
  return std::min(blend.shaped(bare_m), highest_m);
}

bool Earthworks::may_change(glm::vec2 low, glm::vec2 high) const {
  const glm::ivec2 first = earthwork_cell_of(low), last = earthwork_cell_of(high);
  if (std::int64_t(last.x - first.x + 1) * std::int64_t(last.y - first.y + 1) > std::int64_t(cells_.size()))
    return !cells_.empty();
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x)
      if (cells_.contains(key({x, y}))) return true;
  return false;
}

}  // namespace parvis::scene
