#include "reflections/probes/reflections.h"

#include <cassert>

#include "reflections/probes/methods.h"

namespace parvis::probes {

std::unique_ptr<render::Reflections> make_reflections(const scene::Scene& scene) {
  switch (scene.reflection.method) {
    case scene::ReflectionMethod::none:
      return std::make_unique<NoReflection>();
    case scene::ReflectionMethod::rerendered_cube_map:
      return std::make_unique<RerenderedCubeMap>(scene.reflection);
    case scene::ReflectionMethod::time_sliced_cube_map:
      return std::make_unique<TimeSlicedCubeMap>(scene.reflection);
    case scene::ReflectionMethod::shared_cube_map:
      return std::make_unique<SharedCubeMap>(scene.reflection);
    case scene::ReflectionMethod::box_projected_probe:
      return std::make_unique<BoxProjectedProbe>(scene);
    case scene::ReflectionMethod::multiple_environment_maps:
    case scene::ReflectionMethod::local_environment_maps:
    case scene::ReflectionMethod::simple_blend:
    case scene::ReflectionMethod::virtual_objects:
      break;
  }
  assert(false);  // another room's
  return std::make_unique<NoReflection>();
}

std::unique_ptr<render::Reflections> make_surroundings(const scene::Scene& scene) {
  return std::make_unique<TimeSlicedCubeMap>(scene.reflection);
}

void CubeMapReflections::draw_whole(render::CubeMap& map, render::Renderer& renderer,
                                    const render::Reflector& reflector) {
  for (int face = 0; face < 6; ++face)
    map.draw_face(renderer, face, reflector.centre, reflector.object, render::Subjects::all, reflector.shown);
  map.update_levels();
  faces_drawn_ += 6;
}

void CubeMapReflections::bind_map(const gl::Program& program, const render::CubeMap& map) {
  glBindTextureUnit(render::first_reflection_unit, map.texture());
  program.set("reflection_map", int(render::first_reflection_unit));
  program.set("reflection_levels", std::log2(float(map.resolution())));
}

}  // namespace parvis::probes
