// Reflector maps: the surface of each patch of a reflector as a texture over directions.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/image.h"
#include "reflections/reflection_search/map_window.h"
#include "reflections/reflector_maps/map_starts.h"
#include "reflections/reflector_maps/reflector_patches.h"

namespace parvis::reflector_maps {
using namespace reflection_search;

/// A lookup in a map.
struct MapPoint {
  glm::vec3 position, normal;
  float kind;  ///< surface, crease, or the closing surface; see reflector_map.glsl
};

/// Position and normal of a patch by direction from its centre, in the mesh's frame; see reflector_map.glsl.
struct ReflectorMap {
  MapWindow window = all_directions;
  bool is_convex = true;
  bool shows_once = true;  ///< as its patch; if not, vertices are searched layer by layer (patch_search.glsl)
  MapStarts starts;
  ImageF texels;  ///< square, 4 channels: as reflector_map.glsl has them

  /// True if the centre sees surface in all directions.
  bool is_whole_body() const { return window.extent == 1.0f; }
  /// Intersection of a ray from the centre with the surface, or with its closure; `direction` has any length.
  MapPoint sample(glm::vec3 direction) const;
  /// Position and unit normal of `sample`.
  std::pair<glm::vec3, glm::vec3> surface(glm::vec3 direction) const;
  /// `kind` of `sample`.
  float surface_kind(glm::vec3 direction) const;
};

/// The map of a patch that has a centre (reflector_patches), `side` texels wide. 512 texels hold most of a
/// teapot's normals to a hundredth of a degree.
ReflectorMap reflector_map(const ReflectorMesh& mesh, const ReflectorPatch& patch, int side);

/// A reflector prepared for searching: cut into patches, the largest first, each with its map.
struct Reflector {
  ReflectorMesh mesh;
  std::vector<ReflectorPatch> patches;
  std::vector<ReflectorMap> maps;    ///< of the first patches; later ones have none
  std::vector<std::string> remarks;  ///< defects of the mesh and how they were repaired
};

/// Prepares a reflector. Errors name the mesh (see reflector_mesh). Beyond `max_patches` patches only the
/// largest are kept; a remark states the share of the surface without one, where an environment map is shown
/// instead.
Result<Reflector> make_reflector(const Mesh& mesh, const std::string& name, int side,
                                 std::size_t max_patches = 200);

}  // namespace parvis::reflector_maps
