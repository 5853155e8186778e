#include "reflections/methods/reflections.h"

#include <algorithm>

namespace parvis::methods {

void find_reflectors(const render::Renderer& renderer, const scene::Scene& scene, const Camera& camera,
                     std::vector<VisibleReflector>& reflectors) {
  reflectors.clear();
  const float pixels_at_1m = float(renderer.height()) / camera.height_at_1m();
  for (const int object : renderer.visible_objects()) {
    if (!scene.objects[std::size_t(object)].takes_reflection) continue;
    const Bounds& bounds = renderer.gpu().object_bounds()[std::size_t(object)];
    const float distance_m =
        std::max(glm::distance(bounds.centre(), camera.position_in_world()), camera.near_m);
    reflectors.push_back({object, bounds.centre(), 2.0f * bounds.radius() / distance_m * pixels_at_1m});
  }
  std::sort(reflectors.begin(), reflectors.end(),
            [](const VisibleReflector& a, const VisibleReflector& b) { return a.size_px > b.size_px; });
}

bool stands_near(const Bounds& reflector, const Bounds& object, float within_m) {
  const glm::vec3 low = object.min - reflector.min + within_m, high = reflector.max + within_m - object.max;
  return !object.empty() && glm::all(glm::greaterThanEqual(glm::min(low, high), glm::vec3(0.0f)));
}

bool find_near(const render::Renderer& renderer, int object, float within_m,
               std::vector<std::uint8_t>& near) {
  const std::vector<Bounds>& bounds = renderer.gpu().object_bounds();
  near.assign(bounds.size(), 0);
  for (std::size_t o = 0; o < bounds.size(); ++o)
    near[o] = int(o) != object && renderer.gpu().is_visible(int(o)) &&
              stands_near(bounds[std::size_t(object)], bounds[o], within_m);
  return std::ranges::find(near, 1) != near.end();
}

void Reflections::update(render::Renderer& renderer, const scene::Scene& scene, const Camera& camera) {
  find_reflectors(renderer, scene, camera, reflectors_);
  update_for(renderer, scene, reflectors_);
}

void Reflections::update_for(render::Renderer& renderer, const scene::Scene& scene,
                             const std::vector<VisibleReflector>& reflectors) {
  faces_drawn_ = 0;
  if (frame_ != renderer.frames_begun()) begin_frame();
  frame_ = renderer.frames_begun();
  if (fixed_changes_ && fixed_changes_ != renderer.fixed_changes()) forget_surroundings();
  fixed_changes_ = renderer.fixed_changes();
  update_maps(renderer, scene, reflectors);
}

}  // namespace parvis::methods
