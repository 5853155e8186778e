#include "reflections/reference_maps/simple_blend.h"

#include "graphics/gl/sampled_textures.h"
#include "reflections/methods/bindings.h"
#include "reflections/reference_maps/scene_maps.h"

namespace parvis::reference_maps {

void BlendedMapsBlock::bind(const gl::Program& program, const ReferenceMaps& maps,
                            const MapPair& pair) const {
  block_.bind(program, {.layer_size = glm::vec2(float(maps.resolution()), float(ReferenceMaps::border)),
                        .map_pair = glm::vec2(float(pair.first), float(pair.second))});
}

void SimpleBlend::update_maps(render::Renderer& renderer, const scene::Scene&,
                              const std::vector<methods::VisibleReflector>& reflectors) {
  pair_of_object_.resize(renderer.gpu().object_bounds().size());
  for (const methods::VisibleReflector& reflector : reflectors)
    pair_of_object_[std::size_t(reflector.object)] = pair_about(reflector.centre, maps_.places(), choice_);
}

void SimpleBlend::bind(const gl::Program& program, int object) {
  const MapPair& pair = pair_of_object_[std::size_t(object)];
  gl::bind_textures(program, {{"map_colours", methods::first_method_unit, maps_.colours()}});
  blended_.bind(program, maps_, pair);
}

Result<std::unique_ptr<methods::Reflections>> make_simple_blend(const scene::Scene& scene,
                                                                render::Renderer& renderer,
                                                                std::unique_ptr<methods::Reflections>) {
  const HeightPyramid heights(heights_of(scene));
  Result<ReferenceMaps> maps = bake_maps(scene, heights, renderer);
  if (!maps) return maps.errors();
  MapChoice choice(maps->places(), heights);
  return std::unique_ptr<methods::Reflections>(
      std::make_unique<SimpleBlend>(*std::move(maps), std::move(choice)));
}

}  // namespace parvis::reference_maps
