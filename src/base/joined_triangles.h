// Triangle adjacency of a mesh whose vertices may be duplicated: connected pieces, open edges, watertight
// shells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/mesh.h"

namespace parvis {

inline constexpr std::uint32_t no_triangle = ~0u;
/// Stands for "no triangle lies across this edge".

/// Triangle adjacency of a mesh: vertices at one place are merged, degenerate triangles are left out.
struct JoinedTriangles {
  std::vector<std::uint32_t> places;  ///< for each vertex a number that is equal for vertices at one place
  /// Vertices of the mesh's triangles, without those that have no area.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Neighbours of each triangle across its three edges; `no_triangle` at an open edge and where more than
  /// two triangles share it.
  std::vector<std::array<std::uint32_t, 3>> neighbours;
  std::size_t open_edges = 0;  ///< rims, and edges of more than two triangles
};

/// Adjacency of a mesh that `check` accepts. Vertices are merged that are closer than a millionth of the
/// mesh's size, or than the rounding error of floats that far from the origin.
JoinedTriangles joined_triangles(const Mesh& mesh);

/// Triangles that are connected over shared edges.
struct MeshPiece {
  std::vector<std::uint32_t> triangles;  ///< indices into JoinedTriangles::triangles
  bool is_closed = true;                 ///< every edge has a neighbour
};
/// The connected components, in the order of their first triangle.
std::vector<MeshPiece> pieces(const JoinedTriangles& joined);

/// Triangles that are connected over shared edges, including edges that more than two triangles share and
/// slivers without area.
struct MeshShell {
  std::vector<std::uint32_t> triangles;  ///< indices into the mesh; degenerate triangles are left out
  /// Watertight: an even number of triangles shares every edge (duplicates count once) and they enclose a
  /// volume.
  bool is_closed = true;
  double volume = 0.0;  ///< enclosed volume, m3; valid where the triangles are consistently oriented
};
/// The shells of a mesh that `check` accepts: those that are closed bound solid bodies.
std::vector<MeshShell> shells(const Mesh& mesh);

}  // namespace parvis
