// The fine mesh itself, by rays from a centre: what maps are made of, and what they and searches on them are
// judged by.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "graphics/reference/ray_scene.h"
#include "reflections/reflector_maps/reflector_mesh.h"

namespace parvis::reflector_maps {

struct MetSurface {
  glm::vec3 position;
  glm::vec3 normal;  ///< interpolated, unit length
};

class SurfaceRays {
 public:
  /// Of some of the mesh's triangles. The mesh may go.
  SurfaceRays(const ReflectorMesh& mesh, std::span<const std::uint32_t> triangles);

  /// The nearest triangle along a ray, from whichever side. `direction` has any length.
  std::optional<MetSurface> along(glm::vec3 origin, glm::vec3 direction) const;

 private:
  scene::Scene scene_;
  std::unique_ptr<reference::RayScene> rays_;
};

}  // namespace parvis::reflector_maps
