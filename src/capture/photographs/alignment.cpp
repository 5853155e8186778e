#include "capture/photographs/alignment.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtx/quaternion.hpp>
#include <optional>

namespace parvis::photographs {
namespace {

struct LevelAxes {
  glm::dvec3 row, column;  ///< of the picture as it was held: to the right, upward
};

/// The sum over cameras of what has to be perpendicular to up, and of their columns.
struct Levelness {
  glm::dmat3 spread{0.0};
  glm::dvec3 columns{0.0};
};

/// The axes of a picture whose EXIF says how it was held; nothing where it says nothing, or that its top was
/// up.
std::optional<LevelAxes> held_by_exif(const Photograph& photograph) {
  const glm::dvec3 right = glm::dvec3(photograph.world_from_camera[0]), top = photograph.up_in_world();
  switch (photograph.orientation) {
    case 3:
    case 4:
      return LevelAxes{-right, -top};
    case 5:
    case 6:
      return LevelAxes{top, -right};
    case 7:
    case 8:
      return LevelAxes{-top, right};
    default:
      return std::nullopt;
  }
}

/// The camera's axes as EXIF has them, else turned by a quarter where its own right is nearer to `up` than
/// its up is.
LevelAxes held(const Photograph& photograph, glm::dvec3 up) {
  if (const std::optional<LevelAxes> axes = held_by_exif(photograph)) return *axes;
  const glm::dvec3 right = glm::dvec3(photograph.world_from_camera[0]), top = photograph.up_in_world();
  if (std::abs(glm::dot(right, up)) <= std::abs(glm::dot(top, up))) return {right, top};
  return {top, glm::dot(right, up) > 0.0 ? right : -right};
}

Levelness levelness(const PhotographSet& set, glm::dvec3 up) {
  constexpr double weight_of_columns =
      0.002;  // decides only where rows are parallel: columns pitch, rows do not
  Levelness sum;
  for (const Photograph& photograph : set.photographs) {
    const LevelAxes axes = held(photograph, up);
    sum.spread += glm::outerProduct(axes.row, axes.row);
    sum.spread += weight_of_columns * (glm::dmat3(1.0) - glm::outerProduct(axes.column, axes.column));
    sum.columns += axes.column;
  }
  sum.spread *= 1.0 / double(set.photographs.size());
  return sum;
}

/// The direction most perpendicular to what was summed, on the side of the columns.
glm::dvec3 up_of(const glm::dmat3& spread, glm::dvec3 columns) {
  const glm::dvec3 up = eigen_of(spread).vectors[0];
  return glm::dot(up, columns) < 0.0 ? -up : up;
}

}  // namespace

std::optional<glm::dvec3> up_of_cameras(const PhotographSet& set) {
  if (set.photographs.empty()) return std::nullopt;
  const auto top_of = [](const Photograph& photograph) {
    const std::optional<LevelAxes> axes = held_by_exif(photograph);
    return axes ? axes->column : photograph.up_in_world();
  };
  glm::dvec3 up(0.0);
  for (const Photograph& photograph : set.photographs) up += top_of(photograph);
  if (glm::length(up) < 1e-6) up = top_of(set.photographs.front());
  up = glm::normalize(up);
  for (int round = 0; round < 3; ++round) {  // which pictures were held upright becomes clear with `up`
    const Levelness sum = levelness(set, up);
    up = up_of(sum.spread, sum.columns);
  }
  return up;
}

std::optional<glm::dvec3> up_of_place(const PhotographSet& set, const std::vector<OrientedPoint>& points) {
  constexpr double flat = 0.7;
  constexpr std::size_t enough = 50;
  std::optional<glm::dvec3> up = up_of_cameras(set);
  for (const double level_deg : {25.0, 15.0, 8.0, 5.0, 3.0}) {
    if (!up) break;
    glm::dmat3 walls(0.0);
    std::size_t count = 0;
    for (const OrientedPoint& point : points)
      if (point.flatness > flat &&
          std::abs(glm::dot(point.normal, *up)) < std::sin(glm::radians(level_deg))) {
        walls += glm::outerProduct(point.normal, point.normal);
        ++count;
      }
    if (count < enough) break;
    const Levelness sum = levelness(set, *up);
    up = up_of(sum.spread + walls * (1.0 / double(count)), sum.columns);
  }
  return up;
}

void transform(PhotographSet& set, const glm::dmat3& rotation, double scale, glm::dvec3 translation) {
  for (Photograph& photograph : set.photographs) {
    glm::dmat4 pose(rotation * glm::dmat3(photograph.world_from_camera));
    pose[3] = glm::dvec4(scale * (rotation * photograph.position_in_world()) + translation, 1.0);
    photograph.world_from_camera = pose;
  }
  for (SparsePoint& point : set.points)
    point.position_in_world = scale * (rotation * point.position_in_world) + translation;
  glm::dmat4 moved(scale * rotation);
  moved[3] = glm::dvec4(translation, 1.0);
  set.world_from_given = moved * set.world_from_given;
}

double make_z_up(PhotographSet& set, bool is_measured) {
  const std::optional<glm::dvec3> up = up_of_place(set, oriented_points(set));
  if (!up) return 0.0;
  constexpr double near_an_axis_deg = 10.0;
  glm::dvec3 turned_up = *up;
  for (int axis = 0; is_measured && axis < 3; ++axis)
    if (std::abs((*up)[axis]) > std::cos(glm::radians(near_an_axis_deg))) {
      turned_up = glm::dvec3(0.0);
      turned_up[axis] = (*up)[axis] > 0.0 ? 1.0 : -1.0;
    }
  const glm::dvec3 z(0.0, 0.0, 1.0);
  const glm::dmat3 rotation =
      turned_up == -z ? glm::dmat3(1, 0, 0, 0, -1, 0, 0, 0, -1) : glm::mat3_cast(glm::rotation(turned_up, z));
  transform(set, rotation, 1.0, glm::dvec3(0.0));
  return std::acos(std::clamp(up->z, -1.0, 1.0));
}

Result<double> scale_of_distance(const PhotographSet& set, const std::string& a, const std::string& b,
                                 double metres) {
  const Photograph *first = find(set, a), *second = find(set, b);
  if (!first || !second) return error("{}: is none of the calibrated photographs", first ? b : a);
  const double distance = glm::distance(first->position_in_world(), second->position_in_world());
  if (!(distance > 0.0) || !(metres > 0.0))
    return error("{} and {}: stand at one place, or the distance {} is none", a, b, metres);
  return metres / distance;
}

}  // namespace parvis::photographs
