#include "reflections/environment_maps/simple_blend.h"

#include "graphics/render/bindings.h"
#include "reflections/environment_maps/scene_maps.h"

namespace parvis::environment_maps {

void SimpleBlend::update_maps(render::Renderer& renderer, const scene::Scene&,
                              const std::vector<render::Reflector>& reflectors) {
  pair_of_object_.resize(renderer.gpu().object_bounds().size());
  for (const render::Reflector& reflector : reflectors)
    pair_of_object_[std::size_t(reflector.object)] = pair_about(reflector.centre, maps_.places(), choice_);
}

void SimpleBlend::bind(const gl::Program& program, int object) {
  const MapPair& pair = pair_of_object_[std::size_t(object)];
  glBindTextureUnit(render::first_reflection_unit, maps_.colours());
  program.set("map_colours", int(render::first_reflection_unit));
  program.set("layer_size", glm::vec2(float(maps_.resolution()), float(ReferenceMaps::border)));
  program.set("map_pair", glm::vec2(float(pair.first), float(pair.second)));
}

Result<std::unique_ptr<render::Reflections>> make_simple_blend(const scene::Scene& scene,
                                                               render::Renderer& renderer) {
  const HeightPyramid heights(heights_of(scene));
  Result<ReferenceMaps> maps = bake_maps(scene, heights, renderer);
  if (!maps) return maps.errors();
  MapChoice choice(maps->places(), heights);
  return std::unique_ptr<render::Reflections>(
      std::make_unique<SimpleBlend>(*std::move(maps), std::move(choice)));
}

}  // namespace parvis::environment_maps
