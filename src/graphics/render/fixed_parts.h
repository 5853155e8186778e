// What stands still and lets no light through: occluders, and the heights that hide the sky.
#pragma once

#include "scene/scene.h"

namespace parvis::render {

/// Calls `visit(object, part, world_from_mesh)` for every part of the scene that neither moves nor has holes;
/// of hidden objects, too.
template <class Visit>
void for_each_fixed_opaque_part(const scene::Scene& scene, Visit&& visit) {
  for (const scene::Object& object : scene.objects) {
    if (object.is_dynamic) continue;
    const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(*object.model) : object.pose;
    for (const scene::Part& part : object.model->parts) {
      const scene::Material& material = object.model->materials[std::size_t(part.material)];
      if (material.alpha_mode == scene::Alpha::opaque && !material.refracts())
        visit(object, part, object.world_from_model * pose[std::size_t(part.node)]);
    }
  }
}

}  // namespace parvis::render
