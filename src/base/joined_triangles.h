// A mesh's triangles joined where they touch: what hangs together, and where it is open.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/mesh.h"

namespace parvis {

inline constexpr std::uint32_t no_triangle = ~0u;

struct JoinedTriangles {
  std::vector<std::uint32_t> places;  ///< of each vertex a number, the same for vertices at one place
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< those with an area
  /// Across each triangle's three edges: the other triangle, or `no_triangle` at a rim and where more than
  /// two meet.
  std::vector<std::array<std::uint32_t, 3>> neighbours;
  std::size_t open_edges = 0;  ///< rims, and edges of more than two triangles
};

/// Of a mesh that `check` allows. Vertices nearer than a millionth of its size, or than rounding takes them
/// apart so far from the origin, are at one place.
JoinedTriangles joined_triangles(const Mesh& mesh);

/// Triangles that hang together over their edges.
struct MeshPiece {
  std::vector<std::uint32_t> triangles;  ///< of JoinedTriangles
  bool is_closed = true;                 ///< across every edge lies another
};
std::vector<MeshPiece> pieces(const JoinedTriangles& joined);

/// Triangles that hang together over their edges, also over those where more than two meet and over slivers
/// without area.
struct MeshShell {
  std::vector<std::uint32_t> triangles;  ///< of the mesh, all but those without three different places
  /// An even number of triangles meets at every edge, copies counted once, and there is a space between them.
  bool is_closed = true;
  double volume = 0.0;  ///< of that space, where the triangles all run the same way round
};
/// Of a mesh that `check` allows: what of it bounds bodies.
std::vector<MeshShell> shells(const Mesh& mesh);

}  // namespace parvis
