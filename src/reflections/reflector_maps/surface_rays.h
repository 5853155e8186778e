// Ray casting against the original mesh: maps are computed from it, and they and their searches are verified
// against it.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "graphics/reference/ray_scene.h"
#include "reflections/reflector_maps/reflector_mesh.h"

namespace parvis::reflector_maps {

/// Intersection of a ray with the mesh.
struct MetSurface {
  glm::vec3 position;
  glm::vec3 normal;  ///< interpolated, unit length
};

/// A ray hierarchy over some triangles of a reflector's mesh.
class SurfaceRays {
 public:
  /// Copies the given triangles of the mesh.
  SurfaceRays(const ReflectorMesh& mesh, std::span<const std::uint32_t> triangles);

  /// Nearest intersection of a ray, with either side of a triangle; `direction` has any length.
  std::optional<MetSurface> along(glm::vec3 origin, glm::vec3 direction) const;

 private:
  scene::Scene scene_;
  std::unique_ptr<reference::RayScene> rays_;
};

}  // namespace parvis::reflector_maps
