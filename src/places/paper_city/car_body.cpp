#include "places/paper_city/car_body.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace parvis::city {
namespace {

constexpr int body_rows = 9;
constexpr float fixed_row =
    3.4f;  // above it grid lines follow the net; below they spread over what the arches leave
constexpr int arch_pieces = 14;  // of the half circle over a wheel
constexpr int rows_below = 6;    // cells between the lower edge and there
constexpr float columns_apart = 0.5f, rows_apart = 0.7f;

std::vector<glm::vec3> section_points(const BodySection& s) {
  const float rise = s.shoulder - s.sill;
  return {{s.x, 0.93f * s.half_width, s.sill},
          {s.x, 0.975f * s.half_width, s.sill + 0.05f},
          {s.x, 0.995f * s.half_width, s.sill + 0.36f * rise},
          {s.x, 1.0f * s.half_width, s.sill + 0.68f * rise},
          {s.x, 0.99f * s.half_width, s.shoulder},
          {s.x_belt, s.half_belt, s.belt},
          {s.x_top, s.half_top, s.edge},
          {s.x_top, 0.55f * s.half_top, s.top - 0.15f * (s.top - s.edge)},
          {s.x_top, 0.0f, s.top}};
}

/// Sorted lines from 0 to `end` that contain all of `wanted`, with others between them about `apart`.
std::vector<float> grid_lines(float end, std::vector<float> wanted, float apart) {
  wanted.push_back(0.0f), wanted.push_back(end);
  std::sort(wanted.begin(), wanted.end());
  std::vector<float> lines;
  for (const float line : wanted) {
    if (line < 0.0f || line > end) continue;
    if (!lines.empty()) {
      if (line - lines.back() < 1e-4f) continue;
      const float from = lines.back(), gap = line - from;
      const int pieces = std::max(1, int(std::ceil(gap / apart - 0.2f)));
      for (int i = 1; i < pieces; ++i) lines.push_back(from + gap * float(i) / float(pieces));
    }
    lines.push_back(line);
  }
  return lines;
}

class BodyMesher {
 public:
  explicit BodyMesher(const CarShape& shape) : shape_(shape), surface_(body_surface(shape)) {
    std::vector<float> wanted_u, wanted_v{fixed_row};
    for (const BodyRegion& region : shape.regions) {
      wanted_u.insert(wanted_u.end(), {region.u0, region.u1});
      for (const float v : {region.v0, region.v1})
        if (v > fixed_row) wanted_v.push_back(v);
    }
    for (const float axle : {shape.front_axle_x, shape.rear_axle_x}) add_arch_lines(axle, wanted_u);
    u_ = grid_lines(surface_.end_u(), wanted_u, columns_apart);
    v_ = grid_lines(surface_.end_v(), wanted_v, rows_apart);
    v_.erase(v_.begin(), std::find(v_.begin(), v_.end(), fixed_row));
  }

  CarMeshes meshes() {
    std::vector<std::vector<float>> columns;
    columns.reserve(u_.size());
    for (const float u : u_) columns.push_back(column_rows(u));
    for (std::size_t i = 0; i + 1 < u_.size(); ++i)
      for (std::size_t j = 0; j + 1 < columns[i].size(); ++j) add_cell(i, columns[i], columns[i + 1], j);
    for (std::size_t i = 0; i + 1 < u_.size(); ++i) add_underside(i, columns[i][0], columns[i + 1][0]);
    return std::move(meshes_);
  }

 private:
  /// u where the side reaches x; x falls with u.
  float u_at(float x) const {
    float low = 0.5f, high = surface_.end_u() - 0.5f;
    for (int i = 0; i < 30; ++i) {
      const float middle = 0.5f * (low + high);
      (surface_.position(middle, 1.0f).x > x ? low : high) = middle;
    }
    return low;
  }

  void add_arch_lines(float axle, std::vector<float>& wanted) const {
    const float radius = shape_.arch_radius;
    for (int i = 0; i <= arch_pieces; ++i)
      wanted.push_back(u_at(axle + radius * 0.9999f * std::cos(3.14159265f * float(i) / float(arch_pieces))));
    wanted.push_back(u_at(axle + radius + 0.006f)), wanted.push_back(u_at(axle - radius - 0.006f));
  }

  /// The lowest row at a column: 0, or where the wheel arch ends.
  float lowest_row(float u) const {
    for (const float axle : {shape_.front_axle_x, shape_.rear_axle_x}) {
      const float off = surface_.position(u, 0.0f).x - axle, radius = shape_.arch_radius;
      if (std::abs(off) > radius) continue;
      const float height = shape_.wheel_radius + std::sqrt(radius * radius - off * off);
      float low = 0.0f, high = fixed_row - 0.1f;
      for (int i = 0; i < 24; ++i) {
        const float middle = 0.5f * (low + high);
        (surface_.position(u, middle).z < height ? low : high) = middle;
      }
      return low;
    }
    return 0.0f;
  }

  /// Row parameters of a column from its lower edge to the middle of the top.
  std::vector<float> column_rows(float u) const {
    const float lowest = lowest_row(u);
    std::vector<float> result;
    result.reserve(rows_below + v_.size());
    for (int i = 0; i < rows_below; ++i)
      result.push_back(lowest + (fixed_row - lowest) * float(i) / float(rows_below));
    result.insert(result.end(), v_.begin(), v_.end());
    return result;
  }

  CarSurface surface_at(float u, float v) const {
    CarSurface found = CarSurface::paint;
    for (const BodyRegion& r : shape_.regions)
      if (u > r.u0 && u < r.u1 && v > r.v0 && v < r.v1) found = r.surface;
    return found;
  }

  struct Point {
    glm::vec3 position, normal;
    glm::vec2 uv;
  };

  Point point(float u, float v) const {
    Point p{surface_.position(u, v), surface_.normal(u, v), {u, v}};
    const bool is_middle = u <= 0.0f || u >= surface_.end_u() || v >= surface_.end_v();
    if (is_middle) p.position.y = 0.0f, p.normal = glm::normalize(glm::vec3(p.normal.x, 0.0f, p.normal.z));
    return p;
  }

  static Point mirrored(Point p) {
    p.position.y = -p.position.y, p.normal.y = -p.normal.y;
    return p;
  }

  std::uint32_t vertex(CarSurface surface, const Point& p) {
    Mesh& mesh = meshes_[std::size_t(surface)];
    mesh.positions.push_back(p.position), mesh.normals.push_back(p.normal), mesh.uvs.push_back(p.uv);
    return std::uint32_t(mesh.positions.size() - 1);
  }

  void triangle(CarSurface surface, const Point& a, const Point& b, const Point& c) {
    const glm::vec3 area = glm::cross(b.position - a.position, c.position - a.position);
    if (glm::length(area) < 1e-7f) return;
    Mesh& mesh = meshes_[std::size_t(surface)];
    for (const Point& p : {a, b, c}) mesh.indices.push_back(shared_vertex(surface, p));
    for (const Point& p : {a, c, b}) mesh.indices.push_back(shared_vertex(surface, mirrored(p)));
  }

  std::uint32_t shared_vertex(CarSurface surface, const Point& p) {
    const Key key{surface, {p.position.x, p.position.y, p.position.z, p.normal.x, p.normal.y, p.normal.z}};
    const auto [place, is_new] = vertices_.try_emplace(key, 0);
    if (is_new) place->second = vertex(surface, p);
    return place->second;
  }

  /// A cell between columns i and i + 1, both halves. Seen from outside of the left side, u runs to the left
  /// (front to back) and v up.
  void add_cell(std::size_t i, const std::vector<float>& left, const std::vector<float>& right,
                std::size_t j) {
    const float u = 0.5f * (u_[i] + u_[i + 1]), v = 0.25f * (left[j] + left[j + 1] + right[j] + right[j + 1]);
    const CarSurface surface = surface_at(u, v);
    const Point a = point(u_[i], left[j]), b = point(u_[i + 1], right[j]);
    const Point c = point(u_[i + 1], right[j + 1]), d = point(u_[i], left[j + 1]);
    triangle(surface, a, b, c), triangle(surface, a, c, d);
  }

  /// Adds the underside from the lower edge (an arch's too) straight in to the middle: floor and wheel
  /// houses, black.
  void add_underside(std::size_t i, float v0, float v1) {
    const Point a = point(u_[i], v0), b = point(u_[i + 1], v1);
    const glm::vec3 c(b.position.x, 0.0f, b.position.z), d(a.position.x, 0.0f, a.position.z);
    const glm::vec3 across = glm::cross(c - a.position, b.position - a.position);
    if (glm::length(across) < 1e-7f) return;
    const glm::vec3 normal = glm::normalize(across);
    triangle(CarSurface::black, {a.position, normal, a.uv}, {c, normal, b.uv}, {b.position, normal, b.uv});
    triangle(CarSurface::black, {a.position, normal, a.uv}, {d, normal, a.uv}, {c, normal, b.uv});
  }

  using Key = std::pair<CarSurface, std::array<float, 6>>;

  const CarShape& shape_;
  synthesis::SplineSurface surface_;
  std::vector<float> u_, v_;
  CarMeshes meshes_;
  std::map<Key, std::uint32_t> vertices_;
};

}  // namespace

synthesis::SplineSurface body_surface(const CarShape& shape) {
  std::vector<glm::vec3> points;
  for (const BodySection& section : shape.sections) {
    const std::vector<glm::vec3> column = section_points(section);
    points.insert(points.end(), column.begin(), column.end());
  }
  return synthesis::SplineSurface(int(shape.sections.size()), body_rows, std::move(points));
}

CarMeshes body_meshes(const CarShape& shape) { return BodyMesher(shape).meshes(); }

}  // namespace parvis::city
