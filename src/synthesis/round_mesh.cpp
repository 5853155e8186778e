#include "synthesis/round_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace parvis::synthesis {
namespace {

constexpr float turn_of = 2.0f * std::numbers::pi_v<float>;

/// Two triangles for each square of a grid of vertices, `columns` + 1 a row, rows upward, seen from the
/// front.
void add_squares(Mesh& mesh, int rows, int columns) {
  const auto at = [&](int row, int column) { return std::uint32_t(row * (columns + 1) + column); };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      mesh.indices.insert(mesh.indices.end(),
                          {at(row, column), at(row, column + 1), at(row + 1, column + 1), at(row, column),
                           at(row + 1, column + 1), at(row + 1, column)});
}

/// The slope between neighbours; at an end, between it and its one neighbour.
glm::vec2 slope(const Outline& outline, std::size_t i) {
  const glm::vec2 along = outline[std::min(i + 1, outline.size() - 1)] - outline[i == 0 ? 0 : i - 1];
  return along / std::max(glm::length(along), 1e-9f);
}

}  // namespace

Outline smooth(const Outline& points, int parts) {
  Outline fine;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const glm::vec2 before = points[i == 0 ? 0 : i - 1], from = points[i], to = points[i + 1],
                    after = points[std::min(i + 2, points.size() - 1)];
    for (int k = 0; k < parts; ++k) {
      const float t = float(k) / float(parts);
      fine.push_back(from + 0.5f * t *
                                (to - before +
                                 t * (2.0f * before - 5.0f * from + 4.0f * to - after +
                                      t * (3.0f * (from - to) + after - before))));
      fine.back().x = std::max(fine.back().x, 0.0f);
    }
  }
  fine.push_back(points.back());
  return fine;
}

Mesh turned(const Outline& outline, int sides) {
  float length = 0.0f;
  std::vector<float> run{0.0f};
  for (std::size_t i = 1; i < outline.size(); ++i)
    run.push_back(length += glm::distance(outline[i - 1], outline[i]));
  Mesh mesh;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::vec2 along = slope(outline, i);
    for (int side = 0; side <= sides; ++side) {
      const float angle = turn_of * float(side % sides) / float(sides);
      const glm::vec3 out(std::cos(angle), std::sin(angle), 0.0f);
      mesh.positions.push_back(outline[i].x * out + glm::vec3(0.0f, 0.0f, outline[i].y));
      mesh.normals.push_back(along.y * out - glm::vec3(0.0f, 0.0f, along.x));
      mesh.uvs.emplace_back(float(side) / float(sides), 1.0f - run[i] / std::max(length, 1e-9f));
    }
  }
  // A pole's normals all point along the axis.
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (glm::length(glm::vec2(mesh.positions[i])) < 1e-6f)
      mesh.normals[i] = {0.0f, 0.0f, mesh.normals[i].z < 0.0f ? -1.0f : 1.0f};
  add_squares(mesh, int(outline.size()) - 1, sides);
  return mesh;
}

Mesh tube(const std::vector<TubeRing>& rings, int sides) {
  Mesh mesh;
  std::vector<TubeRing> closed = rings;
  closed.insert(closed.begin(), {rings.front().centre, 0.0f});
  closed.push_back({rings.back().centre, 0.0f});
  glm::vec3 aside(0.0f);
  for (std::size_t i = 0; i < closed.size(); ++i) {
    const glm::vec3 along =
        glm::normalize(rings[std::min(std::max(i, std::size_t(1)), rings.size() - 1)].centre -
                       rings[std::min(std::max(i, std::size_t(2)) - 2, rings.size() - 2)].centre);
    // Carried along the curve, so that the skin does not twist.
    if (i == 0) aside = std::abs(along.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
    aside = glm::normalize(aside - glm::dot(aside, along) * along);
    const glm::vec3 across = glm::cross(along, aside);
    for (int side = 0; side <= sides; ++side) {
      const float angle = turn_of * float(side % sides) / float(sides);
      const glm::vec3 out = std::cos(angle) * aside + std::sin(angle) * across;
      mesh.positions.push_back(closed[i].centre + closed[i].radius * out);
      mesh.normals.push_back(i == 0 ? -along : i + 1 == closed.size() ? along : out);
      mesh.uvs.emplace_back(float(side) / float(sides), 1.0f - float(i) / float(closed.size() - 1));
    }
  }
  add_squares(mesh, int(closed.size()) - 1, sides);
  return mesh;
}

Mesh panel(glm::vec3 corner, glm::vec3 right, glm::vec3 up, float cell_m) {
  const float width = glm::length(right), height = glm::length(up);
  const int columns = std::max(int(std::lround(width / cell_m)), 1),
            rows = std::max(int(std::lround(height / cell_m)), 1);
  Mesh mesh;
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) {
      const float s = float(column) / float(columns), t = float(row) / float(rows);
      mesh.positions.push_back(corner + s * right + t * up);
      mesh.uvs.emplace_back(s * width, -t * height);
    }
  mesh.normals.assign(mesh.positions.size(), glm::normalize(glm::cross(right, up)));
  add_squares(mesh, rows, columns);
  return mesh;
}

Mesh panelled_box(glm::vec3 low, glm::vec3 high, float cell_m) {
  const glm::vec3 size = high - low, x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  Mesh mesh;
  append(mesh, panel(low, x, z, cell_m));
  append(mesh, panel(high - z, -x, z, cell_m));
  append(mesh, panel(low + x, y, z, cell_m));
  append(mesh, panel(low + y, -y, z, cell_m));
  append(mesh, panel(low + z, x, y, cell_m));
  append(mesh, panel(low + y, x, -y, cell_m));
  return mesh;
}

}  // namespace parvis::synthesis
