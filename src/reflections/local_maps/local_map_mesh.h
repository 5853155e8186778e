// The mesh of one face of a local map (Meyer and Loscos 2003, section 4.4): a regular mesh whose corners are
// the points that rays from the map's centre meet in the city's heights, each quad split in four where these
// lie at different depths.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reflections/reference_maps/height_pyramid.h"

namespace parvis::local_maps {
using namespace reference_maps;

/// Where a ray that hits nothing is taken to end: so far that all maps see the same sky there.
inline constexpr float sky_distance_m = 1e4f;

/// Texels of a tile that show what lies beyond its face: half of one is left on the coarsest of
/// `local_map_levels`.
inline constexpr int local_map_border = 4;
inline constexpr int local_map_levels = 4;

/// How finely a mesh follows its surroundings.
struct MeshRule {
  int quads = 10;            ///< a side, of the mesh that is split
  float depth_ratio = 0.2f;  ///< R of the paper: a quad is split where depths differ by more than this share
  float smallest_texels = 1.0f;  ///< no quad becomes smaller
};

/// One face to be made.
struct FaceTask {
  glm::vec3 centre;        ///< of the reflector, in the world
  int face;                ///< in OpenGL's order
  int tile;                ///< texels per side, border included
  glm::vec2 corner;        ///< of the tile in the picture of all maps, in texels
  std::uint32_t map_pair;  ///< the two reference maps: first | second << 16
  MeshRule rule;
};

/// A vertex as the shader reads it, 32 bytes.
struct LocalMapVertex {
  glm::vec2 texel;  ///< in the picture of all maps
  float ahead_m;    ///< distance of `met` from the centre along the face's axis
  float texel_rad;  ///< what a texel of this map spans
  glm::vec3 met;    ///< in the world
  std::uint32_t map_pair;
};

/// Kept from frame to frame, so that none of its arrays need be allocated again.
struct FaceMesh {
  std::vector<LocalMapVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< triangles
  float nearest_m = sky_distance_m;    ///< of all hits
};

/// Fills `mesh`, whose triangles cover the tile once everywhere: where a quad meets smaller ones it takes
/// over their corners. Safe to be called for several meshes at once.
void make_face_mesh(const HeightPyramid& heights, const FaceTask& task, FaceMesh& mesh);

}  // namespace parvis::local_maps
