#include "capture/facades/relief.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/progress.h"
#include "capture/photographs/oriented_points.h"

namespace parvis::facades {
namespace {

constexpr int extent_side = 129,
              relief_side = 257;  ///< points per edge, 2^n + 1: to find a surface's extent, its relief
// Shares of the median viewing distance.
constexpr double max_height = 0.4, max_depth = 0.15;  ///< of a relief before and behind its plane
constexpr double height_margin = 0.02;                ///< beyond the points' heights
constexpr double mesh_tolerance = 0.0035;
constexpr double same_surface = 0.02;
constexpr double min_share_on_relief = 0.6;  ///< of a surface that lies on another's relief, to be left out
constexpr std::size_t min_points_for_range = 12;
constexpr std::size_t max_triangles = 6000;  ///< of a surface: layers are cut by every one of them
constexpr double max_disagreement = 0.03;  ///< of two halves of the photographs about a height, of its range
constexpr double min_certain_share = 0.5;  ///< of a surface's points; else it stays flat
constexpr double max_growth = 0.3;         ///< of a surface beyond its points
constexpr double corner_reach = 0.08;      ///< a side is free where no other surface is nearer than this
constexpr double min_grown_share =
    0.5;  ///< of certain points in a line of the grid that the surface grows over
constexpr double range_quantile = 0.01;  ///< of points that do not count for the range

/// The rectangle of a wall or a roof; nothing where it is no rectangle.
std::optional<SweptRectangle> rectangle_of(const CoarseSurface& surface) {
  const std::vector<glm::dvec3>& c = surface.corners;
  // The relief of stairs would be that of what rises behind them.
  if (surface.kind == SurfaceKind::ground || surface.kind == SurfaceKind::slope || c.size() != 4)
    return std::nullopt;
  SweptRectangle rectangle;
  rectangle.origin = c[0], rectangle.u = c[1] - c[0], rectangle.v = c[3] - c[0];
  const double size = glm::length(c[2] - c[0]);
  if (glm::length(c[2] - (c[1] + rectangle.v)) > 1e-3 * size ||
      std::abs(glm::dot(rectangle.u, rectangle.v)) >
          0.05 * glm::length(rectangle.u) * glm::length(rectangle.v))
    return std::nullopt;
  rectangle.normal = glm::normalize(glm::cross(rectangle.u, rectangle.v));
  return rectangle;
}

/// Where a point lies over a rectangle: s, t, height.
glm::dvec3 over(const SweptRectangle& r, glm::dvec3 point) {
  const glm::dvec3 off = point - r.origin;
  return {glm::dot(off, r.u) / glm::dot(r.u, r.u), glm::dot(off, r.v) / glm::dot(r.v, r.v),
          glm::dot(off, r.normal)};
}
bool is_over(glm::dvec3 place) {
  return place.x >= 0.0 && place.x <= 1.0 && place.y >= 0.0 && place.y <= 1.0;
}

/// How far the nearest camera before the rectangle, or before what it may grow over, stands from its plane.
/// A relief is solid down to its plane, and who takes a photograph stands in the open.
double nearest_camera(const SweptRectangle& rectangle, const photographs::PhotographSet& set,
                      double distance) {
  const double beside = max_growth * distance / glm::length(rectangle.u),
               above = max_growth * distance / glm::length(rectangle.v);
  double nearest = std::numeric_limits<double>::infinity();
  for (const photographs::Photograph& photograph : set.photographs) {
    const glm::dvec3 place = over(rectangle, photograph.position_in_world());
    const bool is_before = place.x > -beside && place.x < 1.0 + beside && place.y > 0.0 &&
                           place.y < 1.0 + above && place.z > 0.0;
    if (is_before) nearest = std::min(nearest, place.z);
  }
  return nearest;
}

/// The range of heights that sparse points have over the rectangle, at most up to the nearest camera; it
/// holds the plane itself.
void set_range(SweptRectangle& rectangle, const photographs::PhotographSet& set, double distance) {
  std::vector<double> heights;
  for (const photographs::SparsePoint& point : set.points) {
    const glm::dvec3 place = over(rectangle, point.position_in_world);
    if (is_over(place) && place.z < max_height * distance && place.z > -max_depth * distance)
      heights.push_back(place.z);
  }
  std::ranges::sort(heights);
  const double margin = height_margin * distance;
  const double camera = nearest_camera(rectangle, set, distance);
  rectangle.low = -margin, rectangle.high = std::min(margin, camera);
  if (heights.size() < min_points_for_range) return;
  const auto at = [&](double q) { return heights[std::size_t(std::lround(q * double(heights.size() - 1)))]; };
  rectangle.low = std::min(at(range_quantile), 0.0) - margin;
  rectangle.high = std::min(std::max(at(1.0 - range_quantile), 0.0) + margin, camera);
}

/// Does the surface lie on a relief (or inside it) for the most part?
bool lies_on(const SweptRectangle& surface, const Relief& relief, double tolerance) {
  constexpr int samples = 12;
  int on = 0;
  for (int k = 0; k < samples * samples; ++k) {
    const int row = k / samples;
    const double s = (k % samples + 0.5) / samples, t = (row + 0.5) / samples;
    const glm::dvec3 place = over(relief.rectangle, surface.origin + s * surface.u + t * surface.v);
    if (!is_over(place)) continue;
    const glm::dvec3 heights = relief.heights_around(place.x, place.y);
    on += place.z < heights.z + tolerance && place.z > std::min(heights.y, 0.0) - tolerance;
  }
  return on > min_share_on_relief * samples * samples;
}

/// Longest edge first of right triangles over a square grid: a, b its ends, c the right angle.
class Triangulation {
 public:
  Triangulation(const std::vector<float>& heights, int side, double tolerance)
      : heights_(heights), side_(side), tolerance_(tolerance), errors_(heights.size(), 0.0f) {
    find_errors();
    const glm::ivec2 low(0), high(side - 1);
    divide(low, high, {high.x, 0});
    divide(high, low, {0, high.y});
  }
  const std::vector<std::size_t>& corners() const { return corners_; }

 private:
  std::size_t index(glm::ivec2 p) const { return std::size_t(p.y) * std::size_t(side_) + std::size_t(p.x); }

  /// Each longest edge's middle gets the error of leaving it out, and the greatest of all within its two
  /// triangles: the smallest triangles first. Triangles are numbered as a binary tree: 2 and 3 are the
  /// square's halves, 2 i and 2 i + 1 those of i.
  void find_errors() {
    const std::size_t size = std::size_t(side_ - 1), count = 2 * size * size - 2,
                      parents = count - size * size;
    for (std::size_t i = count; i-- > 0;) {
      const auto [a, b] = longest_edge(i + 2);
      const glm::ivec2 middle = (a + b) / 2, c(middle.x + middle.y - a.y, middle.y + a.x - middle.x);
      float& error = errors_[index(middle)];
      error = std::max(error,
                       std::abs(heights_[index(middle)] - 0.5f * (heights_[index(a)] + heights_[index(b)])));
      if (i < parents) error = std::max({error, errors_[index((a + c) / 2)], errors_[index((b + c) / 2)]});
    }
  }
  std::pair<glm::ivec2, glm::ivec2> longest_edge(std::size_t number) const {
    glm::ivec2 a(0), b(0), c(0);
    if (number & 1)
      b = glm::ivec2(side_ - 1), c.x = side_ - 1;
    else
      a = glm::ivec2(side_ - 1), c.y = side_ - 1;
    while ((number >>= 1) > 1) {
      const glm::ivec2 middle = (a + b) / 2;
      if (number & 1)
        b = a, a = c;
      else
        a = b, b = c;
      c = middle;
    }
    return {a, b};
  }

  void divide(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) {
    const glm::ivec2 middle = (a + b) / 2;
    const bool can_divide = std::abs(a.x - c.x) + std::abs(a.y - c.y) > 1;
    if (can_divide && errors_[index(middle)] > tolerance_) {
      divide(c, a, middle);
      divide(b, c, middle);
    } else {
      for (const glm::ivec2 corner : {a, c, b}) corners_.push_back(index(corner));
    }
  }

  const std::vector<float>& heights_;
  int side_;
  double tolerance_;
  std::vector<float> errors_;
  std::vector<std::size_t> corners_;
};

/// Which sides of a rectangle have no other surface beside them: at s = 0, s = 1, t = 1. Walls stand on the
/// ground.
struct FreeSides {
  bool left = true, right = true, top = true;
};

double distance_to(const SweptRectangle& r, glm::dvec3 point) {
  const glm::dvec3 place = over(r, point);
  const glm::dvec3 nearest =
      r.origin + std::clamp(place.x, 0.0, 1.0) * r.u + std::clamp(place.y, 0.0, 1.0) * r.v;
  return glm::distance(nearest, point);
}

FreeSides free_sides(const CoarseModel& model, const CoarseSurface& surface, const SweptRectangle& r,
                     double reach) {
  FreeSides sides;
  for (const CoarseSurface& other : model.surfaces) {
    const std::optional<SweptRectangle> beside = rectangle_of(other);
    // What faces the same way is part of the relief, or goes on where this surface ends.
    if (&other == &surface || !beside || std::abs(glm::dot(beside->normal, r.normal)) > 0.8) continue;
    const auto is_near = [&](double s, double t) {
      return distance_to(*beside, r.origin + s * r.u + t * r.v) < reach;
    };
    sides.left = sides.left && !is_near(0.0, 0.5), sides.right = sides.right && !is_near(1.0, 0.5);
    sides.top = sides.top && !is_near(0.5, 1.0);
  }
  return sides;
}

/// How many lines of the grid, counted from a side, to cut off: those beyond the last of whose points most
/// are certain.
template <class IsCertain>
int lines_to_cut(int max_lines, IsCertain&& is_certain) {
  for (int line = 0; line < max_lines; ++line) {
    int certain = 0;
    for (int k = 0; k < extent_side; ++k) certain += is_certain(line, k);
    if (certain > min_grown_share * extent_side) return line;
  }
  return max_lines;
}

/// Where two halves of the photographs, each on its own, find a surface at the same height: what photographs
/// agree on without reason (leaves, sky, what is too far away) they place differently. Empty where a half
/// shows nothing.
std::vector<char> certain_points(const SweptRectangle& rectangle, std::span<const GreyPhoto> photos) {
  std::vector<std::size_t> order = photos_of_sweep(rectangle, photos);
  std::vector<GreyPhoto> halves[2];
  for (std::size_t i = 0; i < order.size(); ++i) halves[i % 2].push_back(photos[order[i]]);
  const SweptHeights a = swept_heights(rectangle, halves[0]), b = swept_heights(rectangle, halves[1]);
  if (a.photographs == 0 || b.photographs == 0) return {};
  const double tolerance = std::max(max_disagreement * (rectangle.high - rectangle.low),
                                    glm::length(rectangle.u) / (rectangle.columns - 1));
  std::vector<char> certain(a.heights.size());
  for (std::size_t i = 0; i < certain.size(); ++i)
    certain[i] = std::abs(a.heights[i] - b.heights[i]) <= tolerance;
  return certain;
}

/// The rectangle with margins at its free sides, as far as the photographs are certain of what is there:
/// sparse points seldom reach a wall's end. Nothing where they are not certain of most of the surface itself.
std::optional<SweptRectangle> certain_part(const SweptRectangle& rectangle, const FreeSides& sides,
                                           double margin, std::span<const GreyPhoto> photos) {
  const double width = glm::length(rectangle.u), height = glm::length(rectangle.v);
  const double left = sides.left ? margin / width : 0.0, right = sides.right ? margin / width : 0.0,
               top = sides.top ? margin / height : 0.0;
  SweptRectangle whole = rectangle;
  whole.origin -= left * rectangle.u;
  whole.u *= 1.0 + left + right, whole.v *= 1.0 + top;
  whole.columns = whole.rows = extent_side;
  const std::vector<char> certain = certain_points(whole, photos);
  if (certain.empty()) return std::nullopt;
  constexpr int last = extent_side - 1;
  const auto is_certain = [&](int x, int y) {
    return certain[std::size_t(y) * std::size_t(extent_side) + std::size_t(x)] != 0;
  };
  const auto lines = [](double part, double all) { return int(part / all * last); };
  const int max_left = lines(left, 1.0 + left + right), max_right = lines(right, 1.0 + left + right),
            max_top = lines(top, 1.0 + top);
  long inside = 0, sure = 0;
  for (int y = 0; y <= last - max_top; ++y)
    for (int x = max_left; x <= last - max_right; ++x) ++inside, sure += is_certain(x, y);
  if (double(sure) < min_certain_share * double(inside)) return std::nullopt;
  const double cut_left = lines_to_cut(max_left, [&](int line, int k) { return is_certain(line, k); }),
               cut_right =
                   lines_to_cut(max_right, [&](int line, int k) { return is_certain(last - line, k); }),
               cut_top = lines_to_cut(max_top, [&](int line, int k) { return is_certain(k, last - line); });
  SweptRectangle part = whole;
  part.origin += cut_left / last * whole.u;
  part.u *= 1.0 - (cut_left + cut_right) / last, part.v *= 1.0 - cut_top / last;
  part.columns = part.rows = relief_side;
  return part;
}

/// The mesh, as fine as the limit of triangles allows.
Mesh limited_mesh(const Relief& relief, double tolerance) {
  Mesh mesh = mesh_of(relief, tolerance);
  while (mesh.triangle_count() > max_triangles) mesh = mesh_of(relief, tolerance *= 1.25);
  return mesh;
}

/// The surface as it is, flat.
NamedMesh flat(const CoarseSurface& surface) {
  CoarseModel one;
  one.surfaces.push_back(surface);
  return meshes_of(one).front();
}

}  // namespace

glm::dvec3 Relief::at(double s, double t) const {
  return rectangle.origin + s * rectangle.u + t * rectangle.v + heights_around(s, t).x * rectangle.normal;
}

glm::dvec3 Relief::heights_around(double s, double t) const {
  const int x = std::clamp(int(std::lround(s * (rectangle.columns - 1))), 0, rectangle.columns - 1),
            y = std::clamp(int(std::lround(t * (rectangle.rows - 1))), 0, rectangle.rows - 1);
  const auto height = [&](int column, int row) {
    return double(found.heights[std::size_t(row) * std::size_t(rectangle.columns) + std::size_t(column)]);
  };
  glm::dvec3 heights(height(x, y));
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, rectangle.rows - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, rectangle.columns - 1); ++u)
      heights.y = std::min(heights.y, height(u, v)), heights.z = std::max(heights.z, height(u, v));
  return heights;
}

Mesh mesh_of(const Relief& relief, double tolerance) {
  const SweptRectangle& r = relief.rectangle;
  const Triangulation triangulation(relief.found.heights, r.columns, tolerance);
  Mesh mesh;
  std::vector<std::uint32_t> number(relief.found.heights.size(), ~0u);
  for (const std::size_t corner : triangulation.corners()) {
    if (number[corner] == ~0u) {
      number[corner] = std::uint32_t(mesh.positions.size());
      const std::size_t column = corner % std::size_t(r.columns), row = corner / std::size_t(r.columns);
      const double s = double(column) / (r.columns - 1), t = double(row) / (r.rows - 1);
      mesh.positions.push_back(
          glm::vec3(r.origin + s * r.u + t * r.v + double(relief.found.heights[corner]) * r.normal));
      mesh.normals.push_back(glm::vec3(r.normal)), mesh.uvs.push_back({float(s), float(t)});
    }
    mesh.indices.push_back(number[corner]);
  }
  return mesh;
}

ReliefModel with_reliefs(const CoarseModel& model, const photographs::PhotographSet& set,
                         std::span<const GreyPhoto> photos) {
  const double distance = photographs::viewing_distance(set);
  std::vector<std::size_t> order(model.surfaces.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, std::greater{}, [&](std::size_t i) { return model.surfaces[i].points; });
  ReliefModel result;
  std::vector<NamedMesh> meshes(model.surfaces.size());
  std::vector<Relief> reliefs;
  std::vector<std::string> names;
  Progress progress("sweeping surfaces", order.size());
  for (const std::size_t i : order) {
    progress.advance();
    const CoarseSurface& surface = model.surfaces[i];
    std::optional<SweptRectangle> rectangle = rectangle_of(surface);
    if (!rectangle) {
      meshes[i] = flat(surface);
      continue;
    }
    const auto below = std::ranges::find_if(
        reliefs, [&](const Relief& relief) { return lies_on(*rectangle, relief, same_surface * distance); });
    if (below != reliefs.end()) {
      result.notes.push_back(error("{} is left out: it lies on the relief of {}", surface.name,
                                   names[std::size_t(below - reliefs.begin())]));
      continue;
    }
    set_range(*rectangle, set, distance);
    const FreeSides sides = free_sides(model, surface, *rectangle, corner_reach * distance);
    const std::optional<SweptRectangle> part = certain_part(*rectangle, sides, max_growth * distance, photos);
    if (!part) {
      result.notes.push_back(
          error("{} stays flat: too few photographs show it from different places, or they do not agree on "
                "its relief",
                surface.name));
      meshes[i] = flat(surface);
      continue;
    }
    Relief relief{*part, swept_heights(*part, photos)};
    meshes[i] = {surface.name, limited_mesh(relief, mesh_tolerance * distance)};
    names.push_back(surface.name), reliefs.push_back(std::move(relief));
  }
  for (NamedMesh& mesh : meshes)
    if (!mesh.mesh.indices.empty()) result.meshes.push_back(std::move(mesh));
  return result;
}

}  // namespace parvis::facades
