#include "graphics/shading/body_shape.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <vector>

namespace parvis::shading {
namespace {

using glm::vec2, glm::vec3;
using Triangle = std::array<vec3, 3>;

constexpr int slices = 16;             // of the height
constexpr float min_footprint = 0.2f;  // of the widest slice: narrower ones are poles and aerials
constexpr float open_below = 0.12f;    // of the height: wheels or feet, not a hull
constexpr int cells_per_side = 32;     // of the picture in which coverage is counted

/// All triangles, in shares of the bounds.
std::vector<Triangle> triangles_in_bounds(std::span<const BodyMesh> meshes) {
  std::vector<Triangle> triangles;
  Bounds bounds;
  for (const BodyMesh& part : meshes)
    for (std::size_t i = 0; i + 2 < part.mesh->indices.size(); i += 3) {
      Triangle& triangle = triangles.emplace_back();
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const vec3 position = part.mesh->positions[part.mesh->indices[i + corner]];
        triangle[corner] = vec3(part.model_from_mesh * glm::vec4(position, 1.0f));
        bounds.add(triangle[corner]);
      }
    }
  const vec3 size = bounds.size();
  if (triangles.empty() || !(glm::min(size.x, glm::min(size.y, size.z)) > 0.0f)) return {};
  for (Triangle& triangle : triangles)
    for (vec3& corner : triangle) corner = (corner - bounds.min) / size;
  return triangles;
}

Bounds bounds_of(const Triangle& triangle) {
  Bounds bounds;
  for (const vec3 corner : triangle) bounds.add(corner);
  return bounds;
}

Bounds box_of_widest_slices(const std::vector<Triangle>& triangles) {
  std::array<Bounds, slices> outlines;
  for (const Triangle& triangle : triangles) {
    const Bounds bounds = bounds_of(triangle);
    const int last = std::min(int(bounds.max.z * slices), slices - 1);
    for (int i = std::min(int(bounds.min.z * slices), last); i <= last; ++i)
      outlines[std::size_t(i)].add(bounds);
  }
  const auto footprint = [](const Bounds& outline) {
    return outline.empty() ? 0.0f : outline.size().x * outline.size().y;
  };
  float widest = 0.0f;
  for (const Bounds& outline : outlines) widest = std::max(widest, footprint(outline));

  std::array<std::vector<float>, 4> sides;  // of the wide slices: least x and y, greatest x and y
  float foot = 1.0f, top = 0.0f;
  for (std::size_t i = 0; i < slices; ++i) {
    const Bounds& outline = outlines[i];
    if (!(footprint(outline) >= min_footprint * widest)) continue;
    const float values[]{outline.min.x, outline.min.y, -outline.max.x, -outline.max.y};
    for (std::size_t side = 0; side < 4; ++side) sides[side].push_back(values[side]);
    foot = std::min(foot, float(i) / slices), top = std::max(top, float(i + 1) / slices);
  }
  // The outermost quarter of the slices is left out: mirrors, bumpers, door handles.
  const auto outer = [](std::vector<float>& values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 4];
  };
  return {{outer(sides[0]), outer(sides[1]), std::max(foot, open_below)},
          {-outer(sides[2]), -outer(sides[3]), top}};
}

float twice_area(vec2 a, vec2 b, vec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// The share of the box that the triangles cover, seen along an axis: counted at the middles of cells.
float coverage_along(int axis, const Bounds& box, const std::vector<Triangle>& triangles) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const vec2 minimum(box.min[u], box.min[v]), size(box.size()[u], box.size()[v]);
  std::bitset<std::size_t(cells_per_side) * cells_per_side> covered;
  for (const Triangle& triangle : triangles) {
    std::array<vec2, 3> p;
    for (std::size_t i = 0; i < 3; ++i)
      p[i] = (vec2(triangle[i][u], triangle[i][v]) - minimum) / size * float(cells_per_side) - 0.5f;
    const glm::ivec2 last(cells_per_side - 1);
    const glm::ivec2 from =
        glm::max(glm::ivec2(glm::ceil(glm::min(p[0], glm::min(p[1], p[2])))), glm::ivec2(0));
    const glm::ivec2 to = glm::min(glm::ivec2(glm::floor(glm::max(p[0], glm::max(p[1], p[2])))), last);
    for (int y = from.y; y <= to.y; ++y)
      for (int x = from.x; x <= to.x; ++x) {
        const vec2 cell(x, y);
        const float a = twice_area(p[0], p[1], cell), b = twice_area(p[1], p[2], cell),
                    c = twice_area(p[2], p[0], cell);
        if (std::min(a, std::min(b, c)) >= 0.0f || std::max(a, std::max(b, c)) <= 0.0f)
          covered.set(std::size_t(y) * cells_per_side + std::size_t(x));
      }
  }
  return float(covered.count()) / float(covered.size());
}

}  // namespace

BodyShape body_shape(std::span<const BodyMesh> meshes) {
  const std::vector<Triangle> triangles = triangles_in_bounds(meshes);
  if (triangles.empty()) return {};
  BodyShape shape;
  shape.box = box_of_widest_slices(triangles);
  for (int axis = 0; axis < 3; ++axis) shape.coverage[axis] = coverage_along(axis, shape.box, triangles);
  return shape;
}

}  // namespace parvis::shading
