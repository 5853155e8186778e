#include "reflections/probes/cube_map_reflections.h"

#include "graphics/gl/sampled_textures.h"
#include "reflections/methods/bindings.h"

namespace parvis::probes {

void CubeMapReflections::draw_whole(methods::CubeMap& map, render::Renderer& renderer,
                                    const methods::VisibleReflector& reflector) {
  for (int face = 0; face < 6; ++face)
    map.draw_face(renderer, face, reflector.centre, reflector.object, render::Subjects::all, reflector.shown);
  update_levels(map);
  faces_drawn_ += 6;
}

void CubeMapReflections::update_levels(methods::CubeMap& map) const {
  if (filter_)
    map.update_levels(*filter_);
  else
    map.update_levels();
}

void CubeMapReflections::bind_map(const gl::Program& program, const methods::CubeMap& map) {
  gl::bind_textures(program, {{"reflection_map", methods::first_method_unit, map.texture()}});
  program.set("reflection_levels", std::log2(float(map.resolution())));
}

}  // namespace parvis::probes
