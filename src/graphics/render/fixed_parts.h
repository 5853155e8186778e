// Static, opaque geometry: occluders, and the height field from which sky visibility is computed.
#pragma once

#include <functional>

#include "graphics/shading/heightfield.h"
#include "scene/data/scene.h"
#include "scene/data/surroundings.h"

namespace parvis::render {

/// A static opaque mesh at its place in the world.
struct FixedPart {
  const Mesh& mesh;
  glm::mat4 world_from_mesh;
  int object;       ///< index in the scene; beyond them: scene::for_each_traced_kind
  bool is_visible;  ///< at present
  bool has_backs;   ///< double-sided
};

/// Calls `visit(part)` for every such mesh of the scene's objects, hidden ones included, except what
/// surrounds the place, and backdrops: they hide no sky.
template <class Visit>
void for_each_fixed_object_part(const scene::Scene& scene, Visit&& visit) {
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    const scene::Object& object = scene.objects[o];
    if (object.is_dynamic || scene::surrounds_place(scene, object)) continue;
    const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(*object.model) : object.pose;
    for (const scene::Part& part : object.model->parts) {
      const scene::Material& material = object.model->materials[std::size_t(part.material)];
      if (material.alpha_mode == scene::Alpha::opaque && !material.refracts() && !part.is_backdrop)
        visit(FixedPart{part.mesh, object.world_from_model * pose[std::size_t(part.node)], int(o),
                        object.is_visible, material.is_double_sided});
    }
  }
}

/// The same for static opaque meshes that rooms draw themselves.
void for_each_fixed_traced_part(const scene::Scene& scene,
                                const std::function<void(const FixedPart&)>& visit);

/// Calls `visit(part)` for every static opaque mesh: first those of the scene's objects, then those of rooms.
template <class Visit>
void for_each_fixed_opaque_part(const scene::Scene& scene, Visit&& visit) {
  for_each_fixed_object_part(scene, visit);
  if (!scene.traced_kinds.empty()) for_each_fixed_traced_part(scene, visit);
}

/// World bounds of all static opaque meshes, or of those that are visible.
Bounds bounds_of_fixed_parts(const scene::Scene& scene, bool with_hidden);

/// Raises the heights to the visible static opaque meshes.
void add_fixed_parts(const scene::Scene& scene, shading::Heightfield& heights);

}  // namespace parvis::render
