#include "places/dressing/cone_tiles.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "synthesis/trim_texture.h"

namespace parvis::dressing {
namespace {

constexpr float tile_m = synthesis::roof_sheet_m / float(synthesis::roof_tile_columns);
constexpr float course_m = synthesis::roof_sheet_m / float(synthesis::roof_tile_rows);
constexpr float min_cone_radius_m = 0.4f;  // radius of a cone that is no longer divided
constexpr float fewest_tiles = 6.0f;
constexpr float triangle_counted_at = 0.7f;  // of the way to its foot: half its area lies below
constexpr std::size_t max_rings = 8;

/// Where a course has half as many tiles as below it, from the foot up: fractions of the way from the top to
/// the foot, at whole courses, the foot itself first.
std::vector<float> ring_feet(const ConeSide& cone) {
  std::vector<float> feet{1.0f};
  while (feet.size() < max_rings) {
    const float fraction = course_m / cone.slope_m * std::round(0.5f * feet.back() * cone.slope_m / course_m);
    if (!(fraction * cone.radius_m > min_cone_radius_m) || !(fraction < 0.9f * feet.back())) break;
    feet.push_back(fraction);
  }
  return feet;
}

/// A side of a cone between two directions from its top.
class ConeSector {
 public:
  ConeSector(const ModelTriangle& side, const ConeSide& cone)
      : side_(side), cone_(cone), foot_{(cone.top + 1) % 3, (cone.top + 2) % 3} {
    for (std::size_t k = 0; k < 2; ++k) {
      const glm::vec2 out(side.corners[foot_[k]] - side.corners[cone.top]);
      turns_[k] = std::atan2(out.y, out.x) / glm::two_pi<float>();
    }
    turns_[1] -= std::round(turns_[1] - turns_[0]);  // the short way round
  }

  /// The piece between two fractions of the way to the foot: a triangle at the top, else two.
  void add_ring(float head, float foot, std::vector<TiledPiece>& pieces) const {
    const float counted_at = head > 0.0f ? 0.5f * (head + foot) : triangle_counted_at * foot;
    const float girth_m = glm::two_pi<float>() * cone_.radius_m * counted_at;
    const float sheets =
        std::max(std::round(girth_m / tile_m), fewest_tiles) / float(synthesis::roof_tile_columns);
    const Point left = at(0, foot, sheets), right = at(1, foot, sheets);
    if (head == 0.0f) return pieces.push_back(piece({top(sheets), left, right}));
    const Point left_above = at(0, head, sheets), right_above = at(1, head, sheets);
    pieces.push_back(piece({left_above, left, right}));
    pieces.push_back(piece({left_above, right, right_above}));
  }

 private:
  struct Point {
    glm::vec3 in_model, in_node, normal;
    glm::vec2 uv;
  };

  Point at(std::size_t edge, float fraction, float sheets) const {
    const std::size_t foot = foot_[edge];
    return {glm::mix(side_.corners[cone_.top], side_.corners[foot], fraction),
            glm::mix(side_.corners_in_node[cone_.top], side_.corners_in_node[foot], fraction),
            cone_.normals[foot],
            {sheets * turns_[edge], fraction * cone_.slope_m / synthesis::roof_sheet_m}};
  }
  Point top(float sheets) const {
    return {side_.corners[cone_.top],
            side_.corners_in_node[cone_.top],
            cone_.normals[cone_.top],
            {sheets * 0.5f * (turns_[0] + turns_[1]), 0.0f}};
  }
  TiledPiece piece(const std::array<Point, 3>& corners) const {
    TiledPiece result{side_, {}, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      result.triangle.corners[k] = corners[k].in_model,
      result.triangle.corners_in_node[k] = corners[k].in_node;
      result.uvs[k] = corners[k].uv, result.normals[k] = corners[k].normal;
    }
    return result;
  }

  const ModelTriangle& side_;
  const ConeSide& cone_;
  std::array<std::size_t, 2> foot_;  ///< numbers of the corners at the foot
  std::array<float, 2> turns_{};     ///< directions to these from the top
};

}  // namespace

std::vector<TiledPiece> cone_tiles(const ModelTriangle& side, const ConeSide& cone) {
  const ConeSector whole(side, cone);
  const std::vector<float> feet = ring_feet(cone);
  std::vector<TiledPiece> pieces;
  pieces.reserve(2 * feet.size());
  for (std::size_t i = 0; i < feet.size(); ++i)
    whole.add_ring(i + 1 < feet.size() ? feet[i + 1] : 0.0f, feet[i], pieces);
  return pieces;
}

}  // namespace parvis::dressing
