#include "scene/data/scene.h"

namespace parvis::scene {
namespace {

constexpr float followed_height_m = 0.8f;  // where the eye rests on a vehicle

Camera following(const NamedCamera& named, const glm::mat4& world_from_object) {
  const glm::vec3 position(world_from_object[3]);
  const glm::vec2 axis(world_from_object[0]);
  // an object that stands on end heads north
  const glm::vec2 ahead = glm::length(axis) > 0.0f ? glm::normalize(axis) : glm::vec2(0.0f, 1.0f);
  const glm::vec3 forward(ahead, 0.0f), left(-ahead.y, ahead.x, 0.0f), up(0.0f, 0.0f, 1.0f);
  const glm::vec3 eye =
      position + named.offset_m.x * forward + named.offset_m.y * left + named.offset_m.z * up;
  Camera camera = named.camera;
  if (camera.world_from_camera != glm::mat4(1.0f)) {  // it looks in a direction of its own from the object
    const glm::mat4 world_from_heading(glm::vec4(left, 0.0f) * -1.0f, glm::vec4(forward, 0.0f),
                                       glm::vec4(up, 0.0f), glm::vec4(eye, 1.0f));
    camera.world_from_camera = world_from_heading * camera.world_from_camera;
    return camera;
  }
  const glm::vec3 view = position + followed_height_m * up - eye;
  const bool is_vertical = glm::length(glm::vec2(view)) < 1e-4f * glm::length(view);
  if (glm::length(view) > 0.0f)
    camera.world_from_camera = look_at(eye, eye + view, is_vertical ? forward : up);
  else
    camera.world_from_camera = look_at(eye, eye + forward);  // from within: where the object heads
  return camera;
}

}  // namespace

const NamedCamera* Scene::find_camera(const std::string& name) const {
  for (const NamedCamera& camera : cameras)
    if (camera.name == name) return &camera;
  return nullptr;
}

Result<Camera> Scene::camera_now(const NamedCamera& named) const {
  if (named.follows.empty()) return named.camera;
  for (const Object& object : objects)
    if (object.is_visible && object.name == named.follows) return following(named, object.world_from_model);
  return error("camera \"{}\" follows \"{}\", which is not to be seen", named.name, named.follows);
}

std::size_t Scene::static_triangle_count() const {
  std::size_t count = 0;
  for (const Object& object : objects)
    if (!object.is_dynamic) count += object.model->triangle_count();
  return count;
}

}  // namespace parvis::scene
