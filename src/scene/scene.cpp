#include "scene/scene.h"

namespace parvis::scene {

const NamedCamera* Scene::find_camera(const std::string& name) const {
  for (const NamedCamera& camera : cameras)
    if (camera.name == name) return &camera;
  return nullptr;
}

std::size_t Scene::static_triangle_count() const {
  std::size_t count = 0;
  for (const Object& object : objects)
    if (!object.is_dynamic) count += object.model->triangle_count();
  return count;
}

}  // namespace parvis::scene
