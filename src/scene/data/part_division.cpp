#include "scene/data/part_division.h"

#include <utility>

namespace parvis::scene {
namespace {

constexpr std::uint32_t unused = ~std::uint32_t{0};

/// Triangles of `mesh`, with only the vertices they need. `new_index` is as long as there are vertices, all
/// unused, before and after.
Mesh extracted(const Mesh& mesh, const std::vector<std::uint32_t>& triangles,
               std::vector<std::uint32_t>& new_index) {
  Mesh result;
  for (const std::uint32_t triangle : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t old = mesh.indices[3 * triangle + k];
      if (new_index[old] == unused) {
        new_index[old] = std::uint32_t(result.positions.size());
        append_vertex(result, mesh, old);
      }
      result.indices.push_back(new_index[old]);
    }
  for (const std::uint32_t triangle : triangles)
    for (std::size_t k = 0; k < 3; ++k) new_index[mesh.indices[3 * triangle + k]] = unused;
  return result;
}

/// A part of a mesh that deforms keeps all vertices: its deformation counts them.
Mesh with_all_vertices(const Mesh& mesh, const std::vector<std::uint32_t>& triangles) {
  Mesh result{mesh.positions, mesh.normals, mesh.uvs, {}, mesh.second_uvs, mesh.colours};
  for (const std::uint32_t triangle : triangles)
    for (std::size_t k = 0; k < 3; ++k) result.indices.push_back(mesh.indices[3 * triangle + k]);
  return result;
}

}  // namespace

std::vector<Part> divided(const Part& part, std::span<const std::vector<std::uint32_t>> lists) {
  const Part like{part.object,     {}, part.material, part.node, part.casts_shadow, part.is_backdrop,
                  part.deformation};
  std::vector<std::uint32_t> new_index(part.mesh.positions.size(), unused);
  std::vector<Part> parts;
  parts.reserve(lists.size());
  for (const std::vector<std::uint32_t>& triangles : lists) {
    parts.push_back(like);
    parts.back().mesh = part.deformation ? with_all_vertices(part.mesh, triangles)
                                         : extracted(part.mesh, triangles, new_index);
  }
  return parts;
}

Part split_off(Part& part, const std::vector<bool>& takes) {
  std::vector<std::vector<std::uint32_t>> lists(2);
  for (std::uint32_t triangle = 0; triangle < takes.size(); ++triangle)
    lists[takes[triangle] ? 1 : 0].push_back(triangle);
  std::vector<Part> parts = divided(part, lists);
  part = std::move(parts[0]);
  return std::move(parts[1]);
}

}  // namespace parvis::scene
