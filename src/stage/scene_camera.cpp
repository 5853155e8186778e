#include "stage/scene_camera.h"

#include <algorithm>

#include "base/camera_check.h"
#include "base/known_names.h"
#include "scene/data/surroundings.h"

namespace parvis::stage {
namespace {

/// A camera a little above the south-west, so far that all of the scene is seen.
Camera view_of_all(const Bounds& bounds) {
  Camera camera;
  const float distance_m = std::max(1.3f * bounds.radius(), 2.0f);
  const glm::vec3 eye = bounds.centre() + distance_m * glm::normalize(glm::vec3(-1.0f, -1.2f, 0.8f));
  camera.world_from_camera = look_at(eye, bounds.centre());
  camera.far_m = std::max(camera.far_m, 4.0f * distance_m);
  return camera;
}

/// The bounds of the static geometry.
Bounds fixed_bounds(const scene::Scene& scene) {
  Bounds sum;
  for (const scene::Object& object : scene.objects)
    if (!object.is_dynamic && object.is_visible && !scene::surrounds_place(scene, object))
      sum.add(transformed(object.world_from_model, scene::bounds(*object.model)));
  return sum;
}

}  // namespace

Result<Camera> scene_camera(const scene::Scene& scene, const std::string& name) {
  if (name.empty() && scene.cameras.empty()) {
    const Bounds bounds = fixed_bounds(scene);
    return view_of_all(bounds.empty() ? Bounds{glm::vec3(-1.0f), glm::vec3(1.0f)} : bounds);
  }
  const scene::NamedCamera* named = name.empty() ? &scene.cameras.front() : scene.find_camera(name);
  if (!named) {
    std::vector<std::string> names;
    for (const scene::NamedCamera& camera : scene.cameras) names.push_back(camera.name);
    return error("the scene has no camera \"{}\"{}", name, names_that_exist(name, names));
  }
  const Result<Camera> camera = scene.camera_now(*named);
  if (camera && !is_usable(*camera))
    return error("camera \"{}\" stands beyond {:g} m, or nowhere; check where the object that it follows is",
                 named->name, max_coordinate_m);
  return camera;
}

}  // namespace parvis::stage
