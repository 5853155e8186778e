// A reflector's mesh put in order, so that its maps can be made: triangles joined where they touch, all
// turned outward, with a normal everywhere.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/joined_triangles.h"

namespace parvis::reflector_maps {

/// No triangle without area; normals of unit length on the side of their triangles.
struct ReflectorMesh {
  Mesh mesh;
  /// Neighbours across each triangle's three edges: the other triangle, or `no_triangle` at a rim and where
  /// more than two meet.
  std::vector<std::array<std::uint32_t, 3>> neighbours;

  std::size_t dropped_triangles = 0;  ///< without area
  std::size_t turned_triangles = 0;   ///< whose corners ran the other way round than their neighbours'
  std::size_t open_edges = 0;         ///< rims, and edges of more than two triangles

  std::array<glm::vec3, 3> corners(std::size_t triangle) const;
  std::array<glm::vec3, 3> normals(std::size_t triangle) const;
};

/// Zero normals are missing ones: they become smooth. What encloses a space is turned outward; what is open
/// to the side that its normals are on, or most of its triangles. Errors name the mesh: broken arrays, no
/// triangle with an area.
Result<ReflectorMesh> reflector_mesh(const Mesh& mesh, const std::string& name);

}  // namespace parvis::reflector_maps
