// What is static and lets no light through: occluders, and the heights that hide the sky.
#pragma once

#include <functional>

#include "scene/data/scene.h"

namespace parvis::render {

/// A static mesh without holes, where it stands.
struct FixedPart {
  const Mesh& mesh;
  glm::mat4 world_from_mesh;
  int object;       ///< index in the scene; beyond them: scene::for_each_traced_kind
  bool is_visible;  ///< now
  bool has_backs;   ///< it is there when seen from behind, too
};

/// Calls `visit(part)` for every such mesh of the scene's objects, hidden ones included.
template <class Visit>
void for_each_fixed_object_part(const scene::Scene& scene, Visit&& visit) {
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    const scene::Object& object = scene.objects[o];
    if (object.is_dynamic) continue;
    const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(*object.model) : object.pose;
    for (const scene::Part& part : object.model->parts) {
      const scene::Material& material = object.model->materials[std::size_t(part.material)];
      if (material.alpha_mode == scene::Alpha::opaque && !material.refracts())
        visit(FixedPart{part.mesh, object.world_from_model * pose[std::size_t(part.node)], int(o),
                        object.is_visible, material.is_double_sided});
    }
  }
}

/// The same of what rooms draw by themselves.
void for_each_fixed_traced_part(const scene::Scene& scene,
                                const std::function<void(const FixedPart&)>& visit);

template <class Visit>
void for_each_fixed_opaque_part(const scene::Scene& scene, Visit&& visit) {
  for_each_fixed_object_part(scene, visit);
  if (!scene.traced_kinds.empty()) for_each_fixed_traced_part(scene, visit);
}

}  // namespace parvis::render
