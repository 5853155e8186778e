// Reflector maps: one for each patch of a reflector.
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

/// What a map holds along a direction.
struct MapPoint {
  glm::vec3 position, normal;
  float kind;  ///< the surface, a crease, or what closes it; see reflector_map.glsl
};

/// Position and normal of a patch by direction from its centre; see reflector_map.glsl.
struct ReflectorMap {
  MapWindow window = all_directions;
  bool is_convex = true;
  bool shows_once = true;  ///< as its patch; else a vertex is searched for layer by layer (patch_search.glsl)
  MapStarts starts;
  ImageF texels;  ///< square, 4 channels: as reflector_map.glsl has them

  /// Does the centre see surface all around?
  bool is_whole_body() const { return window.extent == 1.0f; }
  /// Where a ray from the centre meets the surface, or what closes it; `direction` has any length.
  MapPoint sample(glm::vec3 direction) const;
  std::pair<glm::vec3, glm::vec3> surface(glm::vec3 direction) const;
  float surface_kind(glm::vec3 direction) const;
};

/// Of a patch with a centre (reflector_patches), `side` texels wide; 512 hold a teapot's to a hundredth of a
/// degree, most of it.
ReflectorMap reflector_map(const ReflectorMesh& mesh, const ReflectorPatch& patch, int side);

/// A reflector ready to be searched: cut into patches, each with its map, the largest first.
struct Reflector {
  ReflectorMesh mesh;
  std::vector<ReflectorPatch> patches;
  std::vector<ReflectorMap> maps;    ///< of the first patches
  std::vector<std::string> remarks;  ///< what was wrong with the mesh, and what was done about it
};

/// Errors name the mesh (see reflector_mesh); a reflector of more than `max_patches` patches keeps its
/// largest, and says what share of the surface has none: there an environment map stands in.
Result<Reflector> make_reflector(const Mesh& mesh, const std::string& name, int side,
                                 std::size_t max_patches = 200);

}  // namespace parvis::reflector_maps
