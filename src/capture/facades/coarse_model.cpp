#include "capture/facades/coarse_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "capture/photographs/alignment.h"

namespace parvis::facades {
namespace {

using photographs::OrientedPoint;
using photographs::PhotographSet;

// All lengths are shares of the median viewing distance.
constexpr double plane_tolerance = 0.0075;
constexpr double max_gap = 0.15;          // between points of one wall
constexpr double max_corner_gap = 0.25;   // between a wall's last point and the wall that it ends at
constexpr double max_seat_gap = 0.1;      // between a wall's top and the roof above it
constexpr double max_foot_gap = 0.05;     // between the ground and the lower edge of a slope
constexpr double extent_quantile = 0.01;  // of points that do not count for extents
constexpr std::size_t min_points_of_piece = 25;
constexpr double max_looked_through = 0.4;  // share of the rays that reach a surface and do not end there
constexpr double min_extent = 0.1;

struct Range {
  double low = 0.0, high = 0.0;
  double length() const { return high - low; }
};

Range quantiles(std::vector<double> values) {
  std::ranges::sort(values);
  const auto at = [&](double q) { return values[std::size_t(std::lround(q * double(values.size() - 1)))]; };
  return {at(extent_quantile), at(1.0 - extent_quantile)};
}

/// A rectangle in a plane: axis u lies level, v rises.
struct Piece {
  const FoundPlane* plane = nullptr;
  glm::dvec3 u{0.0}, v{0.0};
  Range along, across;
  std::vector<std::size_t> inliers;

  glm::dvec3 at(double s, double t) const { return plane->offset * plane->normal + s * u + t * v; }
};

/// Everything that the stages share.
struct Photographed {
  const PhotographSet& set;
  const std::vector<OrientedPoint>& points;
  glm::dvec3 up;
  double scale;  ///< median viewing distance
};

/// The rectangle around points of a plane.
Piece piece_of(const FoundPlane& plane, std::vector<std::size_t> members, const Photographed& place) {
  Piece piece;
  piece.plane = &plane;
  piece.u = glm::normalize(glm::cross(place.up, plane.normal));
  piece.v = glm::cross(plane.normal, piece.u);
  std::vector<double> s, t;
  for (const std::size_t i : members) {
    s.push_back(glm::dot(place.points[i].position, piece.u));
    t.push_back(glm::dot(place.points[i].position, piece.v));
  }
  piece.along = quantiles(std::move(s));
  piece.across = quantiles(std::move(t));
  piece.inliers = std::move(members);
  return piece;
}

/// Calls `visit(s, t)` for each ray from a camera to a point that it sees where the ray passes through the
/// plane of a piece, well before its end. From behind as well: who stands behind a wall sees nothing of what
/// is before it.
template <class Visit>
void for_rays_through(const Piece& piece, const Photographed& place, Visit&& visit) {
  const double margin = 4.0 * plane_tolerance * place.scale;
  const auto height_of = [&](glm::dvec3 p) { return glm::dot(piece.plane->normal, p) - piece.plane->offset; };
  for (const photographs::SparsePoint& point : place.set.points) {
    const double end = height_of(point.position_in_world);
    if (std::abs(end) < margin) continue;
    for (const photographs::Observation& o : point.observations) {
      const glm::dvec3 eye = place.set.photographs[std::size_t(o.photograph)].position_in_world();
      const double begin = height_of(eye);
      if (std::abs(begin) < margin || (begin > 0.0) == (end > 0.0)) continue;
      const glm::dvec3 hit = glm::mix(eye, point.position_in_world, begin / (begin - end));
      const double s = glm::dot(hit, piece.u), t = glm::dot(hit, piece.v);
      if (t > piece.across.low && t < piece.across.high) visit(s, t);
    }
  }
}

/// A grid over a piece: rays that end at its points less rays that pass through.
struct Evidence {
  int columns = 1, rows = 1;
  std::vector<double> cells;  // row by row, from the lower left

  double& at(int column, int row) {
    return cells[std::size_t(row) * std::size_t(columns) + std::size_t(column)];
  }
};

int cell_of(double value, Range range, int count) {
  return int(std::clamp((value - range.low) / range.length() * count, 0.0, double(count - 1)));
}

Evidence evidence_of(const Piece& piece, const Photographed& place) {
  const double cell = 0.2 * max_gap * place.scale;
  Evidence evidence;
  evidence.columns = int(std::clamp(piece.along.length() / cell, 1.0, 160.0));
  evidence.rows = int(std::clamp(piece.across.length() / cell, 1.0, 160.0));
  evidence.cells.assign(std::size_t(evidence.columns) * std::size_t(evidence.rows), 0.0);
  const auto add = [&](double s, double t, double value) {
    if (s < piece.along.low || s > piece.along.high || t < piece.across.low || t > piece.across.high) return;
    evidence.at(cell_of(s, piece.along, evidence.columns), cell_of(t, piece.across, evidence.rows)) += value;
  };
  for (const std::size_t i : piece.inliers)
    add(glm::dot(place.points[i].position, piece.u), glm::dot(place.points[i].position, piece.v),
        place.points[i].views);
  for_rays_through(piece, place, [&](double s, double t) { add(s, t, -1.0); });
  return evidence;
}

/// Cells [first, last] in both directions.
struct CellRectangle {
  int first_column = 0, last_column = -1, first_row = 0, last_row = -1;
  double sum = 0.0;
  bool holds(int column, int row) const {
    return column >= first_column && column <= last_column && row >= first_row && row <= last_row;
  }
};

/// The rectangle with the largest sum: Kadane's maximum subarray over the columns for each range of rows
/// (Bentley 1984).
CellRectangle largest_sum(Evidence& evidence) {
  CellRectangle best;
  for (int first = 0; first < evidence.rows; ++first) {
    std::vector<double> sums(std::size_t(evidence.columns), 0.0);
    for (int last = first; last < evidence.rows; ++last) {
      double running = 0.0;
      int begin = 0;
      for (int column = 0; column < evidence.columns; ++column) {
        sums[std::size_t(column)] += evidence.at(column, last);
        if (running <= 0.0) running = 0.0, begin = column;
        running += sums[std::size_t(column)];
        if (running > best.sum) best = {begin, column, first, last, running};
      }
    }
  }
  return best;
}

/// The rectangles in a piece where more rays end than pass, the strongest first. They do not overlap.
std::vector<Piece> closed_parts(const Piece& piece, const Photographed& place) {
  constexpr int max_parts = 6;
  constexpr double taken = -1e9;
  std::vector<Piece> parts;
  if (!(piece.along.length() > 0.0) || !(piece.across.length() > 0.0)) return parts;
  Evidence evidence = evidence_of(piece, place);
  for (int part = 0; part < max_parts; ++part) {
    const CellRectangle rectangle = largest_sum(evidence);
    std::vector<std::size_t> members;
    for (const std::size_t i : piece.inliers)
      if (rectangle.holds(cell_of(glm::dot(place.points[i].position, piece.u), piece.along, evidence.columns),
                          cell_of(glm::dot(place.points[i].position, piece.v), piece.across, evidence.rows)))
        members.push_back(i);
    if (members.size() < min_points_of_piece) break;
    parts.push_back(piece_of(*piece.plane, std::move(members), place));
    for (int row = rectangle.first_row; row <= rectangle.last_row; ++row)
      for (int column = rectangle.first_column; column <= rectangle.last_column; ++column)
        evidence.at(column, row) = taken;
  }
  return parts;
}

/// Points of a plane divided where they leave gaps along `u`, then the parts of each that photographs do not
/// look through.
std::vector<Piece> pieces_of(const FoundPlane& plane, const Photographed& place) {
  const glm::dvec3 u = glm::normalize(glm::cross(place.up, plane.normal));
  std::vector<std::size_t> order = plane.inliers, members;
  std::ranges::sort(order, {}, [&](std::size_t i) { return glm::dot(place.points[i].position, u); });
  std::vector<Piece> pieces;
  const auto close = [&] {
    if (members.size() >= min_points_of_piece)
      for (Piece& part : closed_parts(piece_of(plane, members, place), place))
        pieces.push_back(std::move(part));
    members.clear();
  };
  double last = 0.0;
  for (const std::size_t i : order) {
    const double s = glm::dot(place.points[i].position, u);
    if (!members.empty() && s - last > max_gap * place.scale) close();
    members.push_back(i);
    last = s;
  }
  close();
  return pieces;
}

/// The height (along the wall's v) where a wall at `s` meets the ground.
double ground_height(const Piece& wall, double s, const FoundPlane& ground) {
  const glm::dvec3 p = wall.at(s, 0.0);
  return (ground.offset - glm::dot(ground.normal, p)) / glm::dot(ground.normal, wall.v);
}

/// Rays through a rectangle of a piece's plane.
double rays_through(Piece piece, Range along, Range across, const Photographed& place) {
  piece.across = across;
  double through = 0.0;
  for_rays_through(piece, place, [&](double s, double) { through += s > along.low && s < along.high; });
  return through;
}

double rays_ended(const Piece& piece, const Photographed& place) {
  double ended = 0.0;
  for (const std::size_t i : piece.inliers) ended += place.points[i].views;
  return ended;
}

bool is_looked_through(double through, double ended) {
  return through > max_looked_through * (through + ended);
}

/// Do photographs look through a rectangle that a wall would be continued over? Rays through it are compared
/// with those that end on as large a part of the wall: a rich wall says nothing about the gap beside it.
bool is_open(const Piece& wall, Range along, Range across, const Photographed& place) {
  const double area = wall.along.length() * wall.across.length();
  const double through = rays_through(wall, along, across, place);
  if (!(through > 0.0) || !(area > 0.0)) return false;
  return is_looked_through(through, rays_ended(wall, place) * along.length() * across.length() / area);
}

/// Walls stand on the ground, or on the part of the same wall below them, unless photographs look through
/// below.
void stand_on_ground(std::vector<Piece>& walls, const FoundPlane& ground, const Photographed& place) {
  for (Piece& wall : walls) {
    double foot = ground_height(wall, 0.5 * (wall.along.low + wall.along.high), ground);
    for (const Piece& other : walls) {
      const bool is_below = other.plane == wall.plane && &other != &wall &&
                            other.across.low < wall.across.low && other.along.low < wall.along.high &&
                            other.along.high > wall.along.low;
      if (is_below) foot = std::max(foot, other.across.high);
    }
    if (foot >= wall.across.low || !is_open(wall, wall.along, {foot, wall.across.low}, place))
      wall.across.low = foot;
  }
}

/// Lets each end of a wall reach the nearest wall that crosses its line close by, unless photographs look
/// through between them.
void join_corners(std::vector<Piece>& walls, const Photographed& place) {
  const double reach = max_corner_gap * place.scale;
  std::vector<Range> joined;
  for (const Piece& wall : walls) {
    Range range = wall.along;
    double best_low = reach, best_high = reach;
    for (const Piece& other : walls) {
      const double slope = glm::dot(other.plane->normal, wall.u);
      if (&other == &wall || std::abs(slope) < 0.3) continue;
      const double s = (other.plane->offset - glm::dot(other.plane->normal, wall.at(0.0, 0.0))) / slope;
      const double on_other = glm::dot(wall.at(s, 0.0), other.u);
      if (on_other < other.along.low - reach || on_other > other.along.high + reach) continue;
      if (std::abs(s - wall.along.low) < best_low) best_low = std::abs(s - wall.along.low), range.low = s;
      if (std::abs(s - wall.along.high) < best_high)
        best_high = std::abs(s - wall.along.high), range.high = s;
    }
    const Range before{range.low, wall.along.low}, behind{wall.along.high, range.high};
    if (before.length() > 0.0 && is_open(wall, before, wall.across, place)) range.low = wall.along.low;
    if (behind.length() > 0.0 && is_open(wall, behind, wall.across, place)) range.high = wall.along.high;
    joined.push_back(range.length() > 0.0 ? range : wall.along);
  }
  for (std::size_t i = 0; i < walls.size(); ++i) walls[i].along = joined[i];
}

/// Place along a roof's v where its plane crosses that of a wall below its middle; nothing where they do not
/// belong together.
std::optional<double> crossing(const Piece& roof, const Piece& wall) {
  const double overlap =
      std::min(roof.along.high, wall.along.high) - std::max(roof.along.low, wall.along.low);
  const double slope = glm::dot(wall.plane->normal, roof.v);
  if (glm::dot(roof.u, wall.u) < 0.98 || overlap < 0.3 * std::min(roof.along.length(), wall.along.length()) ||
      std::abs(slope) < 0.1)
    return std::nullopt;
  const glm::dvec3 p = roof.at(0.5 * (roof.along.low + roof.along.high), 0.0);
  return (wall.plane->offset - glm::dot(wall.plane->normal, p)) / slope;
}

/// Roofs do not come out of the walls below them; a wall ends where a roof crosses it near its top.
void seat_roofs(std::vector<Piece>& roofs, std::vector<Piece>& walls, const Photographed& place) {
  const double reach = max_seat_gap * place.scale;
  for (Piece& roof : roofs)
    for (Piece& wall : walls) {
      const std::optional<double> t = crossing(roof, wall);
      if (!t || *t > roof.across.high) continue;
      const double top = glm::dot(roof.at(0.5 * (roof.along.low + roof.along.high), *t), wall.v);
      const bool is_near_top = std::abs(top - wall.across.high) < reach;
      if (*t > roof.across.low || (is_near_top && roof.across.low - *t < reach)) roof.across.low = *t;
      if (is_near_top) wall.across.high = top;
    }
}

/// Stairs, ramps and banks rise from the ground; the eaves of roofs are higher.
bool rises_from_ground(const Piece& piece, const FoundPlane& ground, const Photographed& place) {
  const double foot = ground_height(piece, 0.5 * (piece.along.low + piece.along.high), ground);
  return (piece.across.low - foot) * glm::dot(piece.v, place.up) < max_foot_gap * place.scale;
}

/// A slope ends where it meets a wall that looks down on it: what lies in its plane above is part of what
/// stands there.
void end_at_walls(std::vector<Piece>& slopes, const std::vector<Piece>& walls) {
  for (Piece& slope : slopes)
    for (const Piece& wall : walls) {
      const std::optional<double> t = crossing(slope, wall);
      if (t && *t > slope.across.low && *t < slope.across.high && glm::dot(wall.plane->normal, slope.v) < 0.0)
        slope.across.high = *t;
    }
}

/// Takes out surfaces that photographs look through, and slivers: scattered points that happen to lie in a
/// plane.
void leave_out_what_is_no_surface(std::vector<Piece>& pieces, const Photographed& place, Errors& notes) {
  std::erase_if(pieces, [&](const Piece& piece) {
    if (std::min(piece.along.length(), piece.across.length()) < min_extent * place.scale) return true;
    const double through = rays_through(piece, piece.along, piece.across, place),
                 ended = rays_ended(piece, place);
    const bool is_false = is_looked_through(through, ended);
    if (is_false)
      notes.push_back(
          error("a surface of {} points is left out: {:.0f} % of the rays that reach it go through",
                piece.inliers.size(), 100.0 * through / (through + ended)));
    return is_false;
  });
}

/// A level plane below nearly all points, for places whose ground shows no points.
FoundPlane assumed_ground(const Photographed& place) {
  std::vector<double> heights;
  heights.reserve(place.points.size());
  for (const OrientedPoint& point : place.points) heights.push_back(glm::dot(point.position, place.up));
  return {SurfaceKind::ground, place.up, quantiles(std::move(heights)).low, {}};
}

CoarseSurface surface_of(const Piece& piece, SurfaceKind kind) {
  CoarseSurface surface;
  surface.kind = kind;
  surface.points = piece.inliers.size();
  for (const auto& [s, t] : {std::pair(piece.along.low, piece.across.low),
                             {piece.along.high, piece.across.low},
                             {piece.along.high, piece.across.high},
                             {piece.along.low, piece.across.high}})
    surface.corners.push_back(piece.at(s, t));
  return surface;
}

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

/// Counter-clockwise (Andrew 1979).
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points) {
  std::ranges::sort(points, {}, [](glm::dvec2 p) { return std::pair(p.x, p.y); });
  std::vector<glm::dvec2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t base = hull.size();
    for (const glm::dvec2 p : points) {
      while (hull.size() >= base + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

/// Merges corners that lie within `tolerance` of each other: where walls meet, each of them has one there.
std::vector<glm::dvec2> apart(const std::vector<glm::dvec2>& polygon, double tolerance) {
  std::vector<glm::dvec2> kept;
  for (const glm::dvec2 p : polygon)
    if (kept.empty() || glm::distance(p, kept.back()) > tolerance) kept.push_back(p);
  while (kept.size() > 1 && glm::distance(kept.front(), kept.back()) <= tolerance) kept.pop_back();
  return kept;
}

/// The ground below everything: cameras, feet of walls, its own points.
CoarseSurface ground_surface(const FoundPlane& ground, const std::vector<Piece>& walls,
                             const Photographed& place) {
  const glm::dvec3 east = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), ground.normal));
  const glm::dvec3 north = glm::cross(ground.normal, east), origin = ground.offset * ground.normal;
  const auto in_plane = [&](glm::dvec3 p) {
    return glm::dvec2(glm::dot(p - origin, east), glm::dot(p - origin, north));
  };
  std::vector<glm::dvec2> covered;
  std::vector<double> x, y;
  for (const std::size_t i : ground.inliers) {
    const glm::dvec2 p = in_plane(place.points[i].position);
    x.push_back(p.x), y.push_back(p.y);
  }
  const Range across = x.empty() ? Range() : quantiles(x), along = y.empty() ? Range() : quantiles(y);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (x[i] >= across.low && x[i] <= across.high && y[i] >= along.low && y[i] <= along.high)
      covered.push_back({x[i], y[i]});
  for (const photographs::Photograph& photograph : place.set.photographs)
    covered.push_back(in_plane(photograph.position_in_world()));
  for (const Piece& wall : walls)
    for (const double s : {wall.along.low, wall.along.high})
      covered.push_back(in_plane(wall.at(s, wall.across.low)));
  CoarseSurface surface{"ground", SurfaceKind::ground, {}, ground.inliers.size()};
  for (const glm::dvec2 p : apart(convex_hull(std::move(covered)), plane_tolerance * place.scale))
    surface.corners.push_back(origin + p.x * east + p.y * north);
  return surface;
}

void name_surfaces(std::vector<CoarseSurface>& surfaces) {
  std::ranges::sort(surfaces, [](const CoarseSurface& a, const CoarseSurface& b) {
    return std::pair(a.kind, b.points) < std::pair(b.kind, a.points);
  });
  constexpr const char* names[] = {"ground", "wall", "roof", "slope"};
  int counts[std::size(names)] = {};
  for (CoarseSurface& surface : surfaces) {
    const std::size_t kind = std::size_t(surface.kind);
    surface.name =
        surface.kind == SurfaceKind::ground ? names[kind] : fmt::format("{}_{}", names[kind], ++counts[kind]);
  }
}

}  // namespace

Result<CoarseModel> propose_coarse_model(const PhotographSet& set) {
  const std::vector<OrientedPoint> points = photographs::oriented_points(set);
  if (points.size() < min_points_of_piece)
    return error(
        "the photographs have {} points in common and a model needs {}: take sharp photographs of which "
        "three "
        "or more show each place; cameras that came without points get some by parvis facade calibrate "
        "--cameras",
        points.size(), min_points_of_piece);
  const Photographed place{set, points,
                           photographs::up_of_place(set, points).value_or(glm::dvec3(0.0, 0.0, 1.0)),
                           photographs::viewing_distance(set)};
  std::vector<glm::dvec3> cameras;
  cameras.reserve(set.photographs.size());
  for (const photographs::Photograph& photograph : set.photographs)
    cameras.push_back(photograph.position_in_world());
  const std::vector<FoundPlane> planes =
      find_planes(points, place.up, plane_tolerance * place.scale, cameras);

  std::vector<Piece> walls, roofs;
  const FoundPlane* ground = nullptr;
  for (const FoundPlane& plane : planes) {
    if (plane.kind == SurfaceKind::ground && !ground) ground = &plane;
    if (plane.kind == SurfaceKind::ground) continue;
    std::vector<Piece>& kind = plane.kind == SurfaceKind::wall ? walls : roofs;
    for (Piece& piece : pieces_of(plane, place)) kind.push_back(std::move(piece));
  }
  CoarseModel model;
  const FoundPlane assumed = assumed_ground(place);
  if (!ground) {
    model.notes.push_back(error(
        "no ground was found: a level one is assumed below the lowest points; the hint plane ground X Y Z "
        "X Y Z X Y Z ... gives another"));
    ground = &assumed;
  }
  std::vector<Piece> slopes;
  for (const Piece& piece : roofs)
    if (rises_from_ground(piece, *ground, place)) slopes.push_back(piece);
  std::erase_if(roofs, [&](const Piece& piece) { return rises_from_ground(piece, *ground, place); });
  join_corners(walls, place);
  stand_on_ground(walls, *ground, place);
  seat_roofs(roofs, walls, place);
  end_at_walls(slopes, walls);
  for (std::vector<Piece>* pieces : {&walls, &roofs, &slopes})
    leave_out_what_is_no_surface(*pieces, place, model.notes);
  for (const Piece& wall : walls) model.surfaces.push_back(surface_of(wall, SurfaceKind::wall));
  for (const Piece& roof : roofs) model.surfaces.push_back(surface_of(roof, SurfaceKind::roof));
  for (const Piece& slope : slopes) model.surfaces.push_back(surface_of(slope, SurfaceKind::slope));
  model.surfaces.push_back(ground_surface(*ground, walls, place));
  if (model.surfaces.size() == 1)
    return error("no plane was found in {} points; give planes by hints", points.size());
  name_surfaces(model.surfaces);
  return model;
}

std::vector<NamedMesh> meshes_of(const CoarseModel& model) {
  std::vector<NamedMesh> meshes;
  for (const CoarseSurface& surface : model.surfaces) {
    NamedMesh named{surface.name, {}};
    const glm::dvec3 normal = glm::normalize(
        glm::cross(surface.corners[1] - surface.corners[0], surface.corners[2] - surface.corners[0]));
    for (const glm::dvec3& corner : surface.corners) {
      named.mesh.positions.push_back(glm::vec3(corner));
      named.mesh.normals.push_back(glm::vec3(normal));
      named.mesh.uvs.push_back(glm::vec2(0.0f));
    }
    for (std::uint32_t k = 2; k < surface.corners.size(); ++k)
      named.mesh.indices.insert(named.mesh.indices.end(), {0, k - 1, k});
    meshes.push_back(std::move(named));
  }
  return meshes;
}

}  // namespace parvis::facades
