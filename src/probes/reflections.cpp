#include "probes/reflections.h"

#include <algorithm>

#include "probes/methods.h"

namespace parvis::probes {

Result<std::unique_ptr<Reflections>> Reflections::create(const scene::Scene& scene,
                                                         render::Renderer& renderer) {
  std::unique_ptr<Reflections> reflections;
  switch (scene.reflection.method) {
    case scene::ReflectionMethod::none:
      reflections = std::make_unique<NoReflection>();
      break;
    case scene::ReflectionMethod::rerendered_cube_map:
      reflections = std::make_unique<RerenderedCubeMap>(scene.reflection);
      break;
    case scene::ReflectionMethod::time_sliced_cube_map:
      reflections = std::make_unique<TimeSlicedCubeMap>(scene.reflection);
      break;
    case scene::ReflectionMethod::shared_cube_map:
      reflections = std::make_unique<SharedCubeMap>(scene.reflection);
      break;
    case scene::ReflectionMethod::box_projected_probe:
      reflections = std::make_unique<BoxProjectedProbe>(scene);
      break;
  }
  if (Status status = renderer.set_reflection(reflections.get()); !status) return status.errors();
  return reflections;
}

void find_reflectors(const render::Renderer& renderer, const scene::Scene& scene, const Camera& camera,
                     std::vector<Reflector>& reflectors) {
  reflectors.clear();
  const float pixels_at_1m = 0.5f * float(renderer.height()) / std::tan(0.5f * camera.vertical_fov);
  for (const int object : renderer.visible_objects()) {
    if (!scene.objects[std::size_t(object)].takes_reflection) continue;
    const Bounds& bounds = renderer.gpu().object_bounds()[std::size_t(object)];
    const float distance_m =
        std::max(glm::distance(bounds.centre(), camera.position_in_world()), camera.near_m);
    reflectors.push_back({object, bounds.centre(), 2.0f * bounds.radius() / distance_m * pixels_at_1m});
  }
  std::sort(reflectors.begin(), reflectors.end(),
            [](const Reflector& a, const Reflector& b) { return a.size_px > b.size_px; });
}

void Reflections::update(render::Renderer& renderer, const scene::Scene& scene, const Camera& camera) {
  find_reflectors(renderer, scene, camera, reflectors_);
  faces_drawn_ = 0;
  if (fixed_changes_ != renderer.fixed_changes()) forget_surroundings();
  fixed_changes_ = renderer.fixed_changes();
  update_maps(renderer, reflectors_);
}

void Reflections::draw_whole(CubeMap& map, render::Renderer& renderer, glm::vec3 centre, int excluded) {
  for (int face = 0; face < 6; ++face) map.draw_face(renderer, face, centre, excluded);
  map.update_levels();
  faces_drawn_ += 6;
}

void Reflections::bind_map(const gl::Program& program, const CubeMap& map) {
  glBindTextureUnit(render::first_reflection_unit, map.texture());
  program.set("reflection_map", int(render::first_reflection_unit));
  program.set("reflection_levels", std::log2(float(map.resolution())));
}

}  // namespace parvis::probes
