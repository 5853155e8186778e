#include "base/joined_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

namespace parvis {
namespace {

constexpr double same_place = 1e-6;  // of the mesh's size: vertices nearer than this are one
/// The tolerance as a fraction of the greatest coordinate: places touch, too, that are nearer than a few of
/// the steps that numbers have there.
constexpr double few_steps = 4.0 * std::numeric_limits<float>::epsilon();
constexpr double tolerances_per_cell = 8.0;
constexpr double min_area = 1e-12;  // of the size squared

using Triangle = std::array<std::uint32_t, 3>;

/// Vertices by where they are: cells of several tolerances, so that few places lie beside a border.
class Places {
 public:
  Places(const Bounds& bounds, double tolerance) : corner_(bounds.min), tolerance_(tolerance) {}

  /// The number of the place that a point is at; a new one, if it is near none.
  std::uint32_t at(glm::vec3 position) {
    const glm::dvec3 point = glm::dvec3(position) - corner_;  // so that cells have small numbers
    const glm::dvec3 low = point - tolerance_, high = point + tolerance_;
    const Cell first = cell_of(low), last = cell_of(high);
    for (long x = first[0]; x <= last[0]; ++x)
      for (long y = first[1]; y <= last[1]; ++y)
        for (long z = first[2]; z <= last[2]; ++z)
          if (const auto cell = cells_.find({x, y, z}); cell != cells_.end())
            for (const std::uint32_t place : cell->second)
              if (glm::distance(points_[place], point) <= tolerance_) return place;
    points_.push_back(point);
    cells_[cell_of(point)].push_back(std::uint32_t(points_.size() - 1));
    return std::uint32_t(points_.size() - 1);
  }

 private:
  using Cell = std::array<long, 3>;

  Cell cell_of(glm::dvec3 point) const {
    const auto along = [&](double x) { return long(std::floor(x / (tolerances_per_cell * tolerance_))); };
    return {along(point.x), along(point.y), along(point.z)};
  }

  glm::dvec3 corner_;
  double tolerance_;
  std::vector<glm::dvec3> points_;
  std::map<Cell, std::vector<std::uint32_t>> cells_;
};

/// 0 if nothing has an extent, or it is beyond all numbers: then nothing has an area.
double tolerance_of(const Bounds& bounds) {
  const float size = glm::length(bounds.size());
  if (!(size > 0.0f) || !std::isfinite(size)) return 0.0;
  const glm::vec3 far = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
  return std::max(same_place * double(size), few_steps * double(std::max({far.x, far.y, far.z})));
}

/// The place of each vertex: the index of the first vertex that it touches.
std::vector<std::uint32_t> places_of(const Mesh& mesh, const Bounds& bounds, double tolerance) {
  std::vector<std::uint32_t> all;
  all.reserve(mesh.positions.size());
  Places places(bounds, tolerance);
  for (const glm::vec3& position : mesh.positions) all.push_back(places.at(position));
  return all;
}

bool has_three_places(const Triangle& t, const std::vector<std::uint32_t>& places) {
  return places[t[0]] != places[t[1]] && places[t[1]] != places[t[2]] && places[t[2]] != places[t[0]];
}

double area_of(const Mesh& mesh, const Triangle& t) {
  const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

void take_triangles_with_area(const Mesh& mesh, double size, JoinedTriangles& joined) {
  const std::vector<std::uint32_t>& places = joined.places;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const Triangle t{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
    if (!has_three_places(t, places) || area_of(mesh, t) <= min_area * size * size) continue;
    joined.triangles.push_back(t);
  }
}

/// Sets what lies across each edge.
void join(JoinedTriangles& joined) {
  using Side = std::pair<std::uint32_t, std::size_t>;  // triangle, edge
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Side>> edges;
  for (std::size_t t = 0; t < joined.triangles.size(); ++t)
    for (std::size_t e = 0; e < 3; ++e)
      edges[std::minmax(joined.places[joined.triangles[t][e]],
                        joined.places[joined.triangles[t][(e + 1) % 3]])]
          .emplace_back(std::uint32_t(t), e);
  joined.neighbours.assign(joined.triangles.size(), {no_triangle, no_triangle, no_triangle});
  for (const auto& [edge, sides] : edges) {
    if (sides.size() != 2) {
      ++joined.open_edges;
      continue;
    }
    joined.neighbours[sides[0].first][sides[0].second] = sides[1].first;
    joined.neighbours[sides[1].first][sides[1].second] = sides[0].first;
  }
}

/// The triangle's places in the order of its corners, from the lowest on.
Triangle rotated_to_min(const Triangle& t, const std::vector<std::uint32_t>& places) {
  Triangle at{places[t[0]], places[t[1]], places[t[2]]};
  std::rotate(at.begin(), std::min_element(at.begin(), at.end()), at.end());
  return at;
}

/// Triangles of three different places, without copies.
struct Faces {
  std::vector<std::uint32_t> numbers;  ///< in the mesh
  std::vector<Triangle> places;        ///< in the order of their corners
  std::vector<std::uint32_t> face_of;  ///< of each triangle of the mesh, `no_triangle`: of none
};

Faces faces_of(const Mesh& mesh, const std::vector<std::uint32_t>& places) {
  Faces faces;
  std::map<Triangle, std::uint32_t> known;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const Triangle t{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
    faces.face_of.push_back(no_triangle);
    if (!has_three_places(t, places)) continue;
    const auto [entry, is_new] =
        known.try_emplace(rotated_to_min(t, places), std::uint32_t(faces.numbers.size()));
    faces.face_of.back() = entry->second;
    if (!is_new) continue;
    faces.numbers.push_back(std::uint32_t(i / 3));
    faces.places.push_back(entry->first);
  }
  return faces;
}

/// Connected faces, and edges at which an odd number of them meets.
struct Joints {
  std::vector<std::uint32_t> first;  ///< of each face, the first that it hangs together with
  std::vector<std::uint32_t> open;   ///< faces at an edge of an odd number
};

Joints joints_of(const Faces& faces) {
  std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> sides;  // from, to, face
  for (std::uint32_t face = 0; face < faces.places.size(); ++face)
    for (std::size_t e = 0; e < 3; ++e) {
      const auto [from, to] = std::minmax(faces.places[face][e], faces.places[face][(e + 1) % 3]);
      sides.emplace_back(from, to, face);
    }
  std::sort(sides.begin(), sides.end());
  Joints joints;
  joints.first.resize(faces.places.size());
  std::iota(joints.first.begin(), joints.first.end(), 0u);
  const auto first_of = [&](std::uint32_t face) {
    while (joints.first[face] != face) face = joints.first[face] = joints.first[joints.first[face]];
    return face;
  };
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    const auto [from, to, face] = sides[begin];
    for (; end < sides.size() && std::get<0>(sides[end]) == from && std::get<1>(sides[end]) == to; ++end) {
      const std::uint32_t a = first_of(face), b = first_of(std::get<2>(sides[end]));
      joints.first[std::max(a, b)] = std::min(a, b);
    }
    if ((end - begin) % 2 == 1) joints.open.push_back(face);
  }
  for (std::uint32_t face = 0; face < joints.first.size(); ++face) joints.first[face] = first_of(face);
  return joints;
}

}  // namespace

JoinedTriangles joined_triangles(const Mesh& mesh) {
  const Bounds bounds = mesh.bounds();
  const double tolerance = tolerance_of(bounds);
  JoinedTriangles joined;
  if (tolerance == 0.0) {
    joined.places.assign(mesh.positions.size(), 0);
    return joined;
  }
  joined.places = places_of(mesh, bounds, tolerance);
  take_triangles_with_area(mesh, double(glm::length(bounds.size())), joined);
  join(joined);
  return joined;
}

std::vector<MeshPiece> pieces(const JoinedTriangles& joined) {
  std::vector<MeshPiece> all;
  std::vector<bool> seen(joined.triangles.size());
  for (std::uint32_t first = 0; first < joined.triangles.size(); ++first) {
    if (seen[first]) continue;
    MeshPiece& piece = all.emplace_back();
    piece.triangles.push_back(first);
    seen[first] = true;
    for (std::size_t i = 0; i < piece.triangles.size(); ++i)
      for (const std::uint32_t other : joined.neighbours[piece.triangles[i]]) {
        piece.is_closed &= other != no_triangle;
        if (other == no_triangle || seen[other]) continue;
        seen[other] = true;
        piece.triangles.push_back(other);
      }
  }
  return all;
}

std::vector<MeshShell> shells(const Mesh& mesh) {
  const Bounds bounds = mesh.bounds();
  const double tolerance = tolerance_of(bounds);
  if (tolerance == 0.0) return {};
  const Faces faces = faces_of(mesh, places_of(mesh, bounds, tolerance));
  const Joints joints = joints_of(faces);
  std::vector<MeshShell> all;
  std::vector<double> areas;
  std::vector<std::uint32_t> shell_of(faces.numbers.size());  // of what is the first of one
  for (std::uint32_t t = 0; t < faces.face_of.size(); ++t) {
    const std::uint32_t face = faces.face_of[t];
    if (face == no_triangle) continue;
    const std::uint32_t first = joints.first[face];
    if (first == face && faces.numbers[face] == t) {
      shell_of[first] = std::uint32_t(all.size());
      all.emplace_back();
      areas.push_back(0.0);
    }
    MeshShell& shell = all[shell_of[first]];
    shell.triangles.push_back(t);
    if (faces.numbers[face] != t) continue;  // a copy encloses nothing
    const auto corner = [&](std::uint32_t triangle, std::size_t k) {
      return glm::dvec3(mesh.positions[mesh.indices[3 * triangle + k]]);
    };
    const glm::dvec3 origin = corner(faces.numbers[first], 0);
    const glm::dvec3 a = corner(t, 0) - origin, b = corner(t, 1) - origin, c = corner(t, 2) - origin;
    shell.volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    areas[shell_of[first]] += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  for (const std::uint32_t face : joints.open) all[shell_of[joints.first[face]]].is_closed = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].volume = std::abs(all[i].volume);
    all[i].is_closed = all[i].is_closed && all[i].volume > tolerance * areas[i];
  }
  return all;
}

}  // namespace parvis
