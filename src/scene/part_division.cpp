#include "scene/part_division.h"

namespace parvis::scene {
namespace {

/// The triangles of `mesh` for which `takes[i]` is `taken`, with only the vertices they need.
Mesh extracted(const Mesh& mesh, const std::vector<bool>& takes, bool taken) {
  constexpr std::uint32_t unused = ~std::uint32_t{0};
  std::vector<std::uint32_t> new_index(mesh.positions.size(), unused);
  Mesh result;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    if (takes[i / 3] != taken) continue;
    const std::uint32_t old = mesh.indices[i];
    if (new_index[old] == unused) {
      new_index[old] = std::uint32_t(result.positions.size());
      result.positions.push_back(mesh.positions[old]);
      result.normals.push_back(mesh.normals[old]);
      result.uvs.push_back(mesh.uvs[old]);
    }
    result.indices.push_back(new_index[old]);
  }
  return result;
}

/// Of a mesh that bends all vertices stay: its deformation counts them.
Mesh side_of(const Part& part, const std::vector<bool>& takes, bool taken) {
  if (!part.deformation) return extracted(part.mesh, takes, taken);
  Mesh side = part.mesh;
  side.indices.clear();
  for (std::size_t i = 0; i < part.mesh.indices.size(); ++i)
    if (takes[i / 3] == taken) side.indices.push_back(part.mesh.indices[i]);
  return side;
}

}  // namespace

Part split_off(Part& part, const std::vector<bool>& takes) {
  Part taken = part;
  taken.mesh = side_of(part, takes, true);
  part.mesh = side_of(part, takes, false);
  return taken;
}

}  // namespace parvis::scene
