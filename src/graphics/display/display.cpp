#include "graphics/display/display.h"

#include <algorithm>
#include <set>

#include "graphics/display/frusta.h"

namespace parvis::display {
namespace {

/// Axes, size and normal of a rectangle.
struct Rectangle {
  glm::dvec3 right, up, normal;
  double width, height;
  explicit Rectangle(const Wall& wall)
      : right(wall.lower_right - wall.lower_left),
        up(wall.upper_left - wall.lower_left),
        normal(glm::cross(right, up)),
        width(glm::length(right)),
        height(glm::length(up)) {}
};

/// The part of the rectangle `of` that `other`, which lies in its plane, covers: lower and upper share in
/// each direction; nothing where it covers none.
std::optional<std::array<glm::dvec2, 2>> covered(const Wall& of, const Wall& other) {
  constexpr double within = 1e-3;  // of the wall's width: two walls are built that exactly
  const Rectangle a(of), b(other);
  const double reach = within * a.width;
  const glm::dvec3 normal = glm::normalize(a.normal);
  for (const glm::dvec3& corner : {other.lower_left, other.lower_right, other.upper_left})
    if (std::abs(glm::dot(corner - of.lower_left, normal)) > reach) return std::nullopt;
  if (glm::dot(b.right, a.right) < (1.0 - within) * a.width * b.width) return std::nullopt;
  std::array<glm::dvec2, 2> result;
  for (int axis = 0; axis < 2; ++axis) {
    const glm::dvec3 along = axis == 0 ? a.right : a.up;
    const double length2 = glm::dot(along, along);
    const double from = glm::dot(other.lower_left - of.lower_left, along) / length2;
    const double to = from + glm::dot(axis == 0 ? b.right : b.up, along) / length2;
    result[0][axis] = std::clamp(from, 0.0, 1.0), result[1][axis] = std::clamp(to, 0.0, 1.0);
    if (result[1][axis] - result[0][axis] < within) return std::nullopt;
  }
  return result;
}

}  // namespace

std::optional<Stereo> stereo_named(const std::string& name) {
  const auto found = std::ranges::find(stereo_names, name);
  if (found == stereo_names.end()) return std::nullopt;
  return Stereo(found - stereo_names.begin());
}

void find_overlaps(Display& display) {
  constexpr double nearly_all = 0.9;
  for (Wall& wall : display.walls) {
    if (wall.is_curved || std::ranges::any_of(wall.overlap, [](double share) { return share > 0.0; }))
      continue;
    for (const Wall& other : display.walls) {
      if (&other == &wall || other.is_curved) continue;
      const auto both = covered(wall, other);
      if (!both) continue;
      const glm::dvec2 from = (*both)[0], to = (*both)[1], size = to - from;
      // A neighbour covers an edge whole: beside the wall where it is narrow, above or below where it is low.
      if (size.x > nearly_all && size.y > nearly_all) continue;
      if (size.y > nearly_all) {
        if (from.x <= 0.0) wall.overlap[0] = std::max(wall.overlap[0], to.x);
        if (to.x >= 1.0) wall.overlap[1] = std::max(wall.overlap[1], 1.0 - from.x);
      } else if (size.x > nearly_all) {
        if (from.y <= 0.0) wall.overlap[2] = std::max(wall.overlap[2], to.y);
        if (to.y >= 1.0) wall.overlap[3] = std::max(wall.overlap[3], 1.0 - from.y);
      }
    }
  }
}

Status set_keystone(Wall& wall, const std::array<glm::dvec2, 4>& corners) {
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec2 a = corners[i], b = corners[(i + 1) % 4], c = corners[(i + 2) % 4];
    if ((b - a).x * (c - b).y - (b - a).y * (c - b).x <= 1e-6)
      return error(
          "{}: the four corners of \"keystone\" are no convex shape, counter-clockwise from the lower "
          "left",
          wall.name);
  }
  // The projective map of the unit square to a quadrilateral (Heckbert 1989, section 2.2.3).
  const auto [p0, p1, p2, p3] = std::tuple(corners[0], corners[1], corners[2], corners[3]);
  const glm::dvec2 sum = p0 - p1 + p2 - p3, d1 = p1 - p2, d2 = p3 - p2;
  const double whole = d1.x * d2.y - d2.x * d1.y;
  const double g = (sum.x * d2.y - d2.x * sum.y) / whole, h = (d1.x * sum.y - sum.x * d1.y) / whole;
  const glm::dvec3 upper_right = glm::dvec3(wall.lower_right + wall.upper_left - wall.lower_left);
  const std::array weights{1.0, 1.0 + g, 1.0 + g + h, 1.0 + h};
  const std::array points{wall.lower_left, wall.lower_right, upper_right, wall.upper_left};
  const std::array<glm::vec2, 4> shares{glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)};
  wall.columns = 2;
  wall.surface.clear();
  for (const std::size_t i : {0u, 1u, 3u, 2u})
    wall.surface.push_back({glm::vec3(points[i]), glm::vec3(corners[i] * weights[i], weights[i]), shares[i]});
  return Ok{};
}

Result<Display> checked(Display display, const std::string& file) {
  constexpr double right_angle = 0.02;  // the cosine of what is no right angle any more
  if (display.walls.empty()) return error("{}: there is no wall", file);
  if (display.walls.size() > max_walls)
    return error("{}: {} walls; a display has {} at most", file, display.walls.size(), max_walls);
  std::set<std::string> names;
  for (Wall& wall : display.walls) {
    const auto wrong = [&](const std::string& what) {
      return error("{}: wall \"{}\" {}", file, wall.name, what);
    };
    if (!names.insert(wall.name).second) return wrong("stands there twice; each needs a name of its own");
    if (wall.overlap[0] + wall.overlap[1] > 1.0 || wall.overlap[2] + wall.overlap[3] > 1.0)
      return wrong("has overlaps that meet: those of two opposite sides are 1 together at most");
    if (!wall.is_curved) {
      const Rectangle shape(wall);
      if (shape.width < 1e-3 || shape.height < 1e-3 ||
          glm::length(shape.normal) < 1e-3 * shape.width * shape.height)
        return wrong("has three corners in a line, or two in one place");
      if (std::abs(glm::dot(shape.right, shape.up)) > right_angle * shape.width * shape.height)
        return wrong("has no right angle at its corner: its sides are not those of a rectangle");
      if (wall.surface.empty())
        if (Status status = set_keystone(wall, {glm::dvec2(0, 0), {1, 0}, {1, 1}, {0, 1}}); !status)
          return status.errors();
    }
    if (!is_before(wall, display.eye))
      return wrong(wall.is_curved
                       ? "spans too wide an angle as the eye sees it; divide it among several walls"
                       : "shows its back to the eye: its lower left corner is to be the eye's left");
  }
  find_overlaps(display);
  return display;
}

}  // namespace parvis::display
