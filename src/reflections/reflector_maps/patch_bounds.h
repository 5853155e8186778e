// What a patch of a reflector cannot show, told from a ball about it and a cone about its normals, without
// looking at a vertex: patches that face away, and meshes that no ray mirrored in the patch can meet.
#pragma once

#include "base/bounds.h"
#include "reflections/reflector_maps/reflector_patches.h"

namespace parvis::reflector_maps {

struct PatchBounds {
  Bounds box;               ///< of its own triangles, in the mesh's frame, as all here
  glm::vec3 axis{0, 0, 1};  ///< of the cone
  float spread = 4.0f;      ///< radians between the axis and any normal, at most

  /// False only where every normal points away from the viewer.
  bool may_be_seen(glm::vec3 viewer) const;
  /// False only where nothing within `radius` of `centre` can be mirrored to the viewer.
  bool may_show(glm::vec3 viewer, glm::vec3 centre, float radius) const;
  /// About how wide the viewer sees the image of a ball of `radius` about `centre`, as the tangent of an
  /// angle: as in a mirror ball that bends as the patch does as a whole, and no wider than the patch itself.
  float image_width(glm::vec3 viewer, glm::vec3 centre, float radius, bool is_convex) const;
};

PatchBounds patch_bounds(const ReflectorMesh& mesh, const ReflectorPatch& patch);

}  // namespace parvis::reflector_maps
