#include "land/roads/asphalt_cover.h"

#include <algorithm>
#include <cmath>

namespace parvis::scene {
namespace {

constexpr float asphalt_cell_m = 8.0f;
constexpr float farthest_asphalt_cell = 1e8f;  // lanes may reach farther than cells have numbers
constexpr float level_m = 1.0f;
// Asphalt so far around a place that is looked at: places of a grid this wide leave nothing out. Neighbouring
// lanes overlap by more than twice as much.
constexpr float margin_around_m = 0.2f, grid_m = 0.28f;
static_assert(2.0f * margin_around_m * margin_around_m >= 0.5f * grid_m * grid_m);

glm::ivec2 asphalt_cell_of(glm::vec2 point) {
  return glm::ivec2(
      glm::clamp(glm::floor(point / asphalt_cell_m), -farthest_asphalt_cell, farthest_asphalt_cell));
}

std::uint64_t key(int x, int y) { return std::uint64_t(std::uint32_t(x)) << 32u | std::uint32_t(y); }

int steps_along(glm::vec3 a, glm::vec3 b) {
  return std::max(1, int(std::ceil(glm::distance(glm::vec2(a), glm::vec2(b)) / grid_m)));
}

}  // namespace

AsphaltCover::AsphaltCover(const std::vector<AsphaltStrip>& strips) {
  for (std::size_t strip = 0; strip < strips.size(); ++strip) {
    const Path& middle = strips[strip].middle;
    for (std::size_t i = 0; i + 1 < middle.size(); ++i) {
      const auto index = std::uint32_t(pieces_.size());
      const float half_m = strips[strip].half_m - margin_around_m;
      pieces_.push_back(
          {middle[i], middle[i + 1], half_m, std::uint32_t(strip), i == 0, i + 2 == middle.size()});
      const glm::ivec2 low = asphalt_cell_of(glm::vec2(glm::min(middle[i], middle[i + 1])) - half_m),
                       high = asphalt_cell_of(glm::vec2(glm::max(middle[i], middle[i + 1])) + half_m);
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) cells_[key(x, y)].push_back(index);
    }
  }
}

bool AsphaltCover::is_over(std::uint32_t own, glm::vec3 point) const {
  const glm::ivec2 cell = asphalt_cell_of(glm::vec2(point));
  const auto here = cells_.find(key(cell.x, cell.y));
  if (here == cells_.end()) return false;
  return std::ranges::any_of(here->second, [&](std::uint32_t index) {
    const Piece& piece = pieces_[index];
    if (piece.strip == own) return false;
    const glm::vec2 along(piece.to - piece.from), away(point - piece.from);
    const float length_m = glm::length(along);
    if (!(length_m > 0.0f)) return false;
    const float at_m = glm::dot(away, along) / length_m;
    if ((piece.is_first && at_m < margin_around_m) || (piece.is_last && at_m > length_m - margin_around_m))
      return false;
    const float fraction = glm::clamp(at_m / length_m, 0.0f, 1.0f);
    return glm::distance(away, fraction * along) <= piece.half_m &&
           std::abs(glm::mix(piece.from.z, piece.to.z, fraction) - point.z) < level_m;
  });
}

bool AsphaltCover::hides(std::uint32_t own, glm::vec3 near_left, glm::vec3 near_right, glm::vec3 far_left,
                         glm::vec3 far_right) const {
  for (const glm::vec3& corner : {near_left, near_right, far_left, far_right})
    if (!is_over(own, corner)) return false;
  const int across = std::max(steps_along(near_left, near_right), steps_along(far_left, far_right)),
            along = std::max(steps_along(near_left, far_left), steps_along(near_right, far_right));
  for (int i = 0; i <= along; ++i)
    for (int k = 0; k <= across; ++k) {
      const float u = float(k) / float(across), v = float(i) / float(along);
      if (!is_over(own, glm::mix(glm::mix(near_left, near_right, u), glm::mix(far_left, far_right, u), v)))
        return false;
    }
  return true;
}

}  // namespace parvis::scene
