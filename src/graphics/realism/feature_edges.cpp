#include "graphics/realism/feature_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace parvis::realism {
namespace {

using glm::vec3;

/// A corner in a lattice of a fifth of a millimetre: corners of neighbours may differ by rounding.
struct Knot {
  long x, y, z;
  auto operator<=>(const Knot&) const = default;
};

Knot knot_at(const vec3& p) {
  constexpr double per_m = 5000.0, shift = 0.37;  // round numbers lie within cells
  const auto along = [](float value) { return std::lround(double(value) * per_m + shift); };
  return {along(p.x), along(p.y), along(p.z)};
}

/// One side of a triangle.
struct Side {
  Knot low, high;  ///< both triangles of an edge have the same
  vec3 from, to, normal;
  int part, material;

  auto ends() const { return std::tie(low, high); }
};

bool has_edges(const scene::Model& model, const scene::Part& part) {
  const scene::Material& material = model.materials[std::size_t(part.material)];
  return material.alpha_mode != scene::Alpha::cutout && !part.deformation && !part.is_backdrop;
}

/// Adds the sides of a part's triangles; returns its surface, m2.
double add_sides(const scene::Part& part, int number, std::vector<Side>& sides) {
  double area_m2 = 0.0;
  const Mesh& mesh = part.mesh;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const vec3 corners[3]{mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                          mesh.positions[mesh.indices[i + 2]]};
    const vec3 facet = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const float doubled = glm::length(facet);
    const Knot knots[3]{knot_at(corners[0]), knot_at(corners[1]), knot_at(corners[2])};
    const bool is_sliver = knots[0] == knots[1] || knots[1] == knots[2] || knots[2] == knots[0];
    if (is_sliver || !(doubled > 0.0f)) continue;  // it has no side that is seen
    area_m2 += 0.5 * double(doubled);
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      sides.push_back({std::min(knots[k], knots[next]), std::max(knots[k], knots[next]), corners[k],
                       corners[next], facet / doubled, number, part.material});
    }
  }
  return area_m2;
}

/// Adds the edge of the triangles that share these two ends; nothing where they lie in one plane.
void add_edge(std::span<const Side> shared, std::vector<PartEdges>& parts) {
  const Side& first = shared.front();
  Edge edge{first.from, first.to, first.normal, shared.back().normal, true};
  if (shared.size() == 2) {
    const float cosine = glm::dot(edge.normal, edge.other_normal);
    const bool is_border = first.material != shared.back().material;
    edge.is_drawn_always = is_border || cosine < std::cos(crease_angle);
    constexpr float same_plane = 0.99999f;
    if (!edge.is_drawn_always && cosine > same_plane) return;
  }
  parts[std::size_t(first.part)].edges.push_back(edge);
}

}  // namespace

std::vector<PartEdges> feature_edges(const scene::Model& model) {
  std::vector<PartEdges> parts(model.parts.size());
  std::vector<double> area_m2(parts.size(), 0.0);
  std::vector<Side> sides;
  for (int node = 0; node < int(model.nodes.size()); ++node) {
    sides.clear();
    for (std::size_t p = 0; p < parts.size(); ++p)
      if (model.parts[p].node == node && has_edges(model, model.parts[p]))
        area_m2[p] = add_sides(model.parts[p], int(p), sides);
    std::ranges::stable_sort(sides, {}, &Side::ends);
    for (auto first = sides.begin(); first != sides.end();) {
      const auto end =
          std::find_if(first, sides.end(), [&](const Side& s) { return s.ends() != first->ends(); });
      add_edge({first, end}, parts);
      first = end;
    }
  }
  for (std::size_t p = 0; p < parts.size(); ++p) {
    double length_m = 0.0;
    for (const Edge& edge : parts[p].edges)
      if (edge.is_drawn_always) length_m += double(glm::distance(edge.from, edge.to));
    parts[p].spacing_m =
        length_m > 0.0 ? float(area_m2[p] / length_m) : std::numeric_limits<float>::infinity();
  }
  return parts;
}

}  // namespace parvis::realism
