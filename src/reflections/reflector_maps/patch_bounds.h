// Conservative visibility of a reflector's patch, from its bounding box and the cone of its normals, without
// visiting vertices: back-facing patches, and meshes that no mirrored ray can reach.
#pragma once

#include "base/bounds.h"
#include "reflections/reflector_maps/reflector_patches.h"

namespace parvis::reflector_maps {

/// Bounding box and normal cone of a patch, in the mesh's frame, as are all arguments.
struct PatchBounds {
  Bounds box;               ///< of the patch's own triangles
  glm::vec3 axis{0, 0, 1};  ///< of the normal cone
  float spread = 4.0f;      ///< maximum angle between the axis and a normal, radians

  /// False only if every normal faces away from the viewer.
  bool may_be_seen(glm::vec3 viewer) const;
  /// False only if nothing within `radius` of `centre` can be mirrored to the viewer.
  bool may_show(glm::vec3 viewer, glm::vec3 centre, float radius) const;
  /// Approximate angular width (as a tangent) of the reflection of a sphere of `radius` around `centre`, as
  /// in a spherical mirror with the patch's mean curvature; at most that of the patch itself.
  float image_width(glm::vec3 viewer, glm::vec3 centre, float radius, bool is_convex) const;
};

/// Computes the bounds of a patch.
PatchBounds patch_bounds(const ReflectorMesh& mesh, const ReflectorPatch& patch);

}  // namespace parvis::reflector_maps
