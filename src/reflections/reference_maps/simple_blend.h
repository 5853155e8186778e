// Simple blending (Meyer and Loscos 2003, sections 3 and 5; figure 9a): two reference maps looked up by
// direction alone and averaged. Local maps fall back to it in the distance and are compared with it.
#pragma once

#include "graphics/gl/uniform_block.h"
#include "graphics/shading/glsl.h"
#include "reflections/methods/bindings.h"
#include "reflections/methods/reflections.h"
#include "reflections/reference_maps/map_pair.h"
#include "reflections/reference_maps/reference_maps.h"

namespace parvis::reference_maps {

namespace simple_blend_block {
using namespace parvis::shading;
#include "reflections/reference_maps/simple_blend_block.glsl"
}  // namespace simple_blend_block

/// The uniform block of simple_blend.glsl, for methods that include it.
class BlendedMapsBlock {
 public:
  /// Hands a program the pair of maps that it blends; `maps` holds them.
  void bind(const gl::Program& program, const ReferenceMaps& maps, const MapPair& pair) const;

 private:
  gl::UniformBlock<simple_blend_block::BlendedMaps> block_{"BlendedMaps", methods::first_method_block};
};

/// Creates the method for a scene; bakes the reference maps. Errors: a shader, or the baking.
Result<std::unique_ptr<methods::Reflections>> make_simple_blend(
    const scene::Scene& scene, render::Renderer& renderer,
    std::unique_ptr<methods::Reflections> below = nullptr);

/// The reference maps, and the pair that each object uses in this frame.
class SimpleBlend final : public methods::Reflections {
 public:
  /// `choice` selects the pair of maps for a position.
  SimpleBlend(ReferenceMaps maps, MapChoice choice) : maps_(std::move(maps)), choice_(std::move(choice)) {}

  render::SurfaceSource source() const override {
    return {.fragment = "reflections/reference_maps/simple_blend.frag"};
  }
  void bind(const gl::Program& program, int object) override;

 private:
  void update_maps(render::Renderer& renderer, const scene::Scene& scene,
                   const std::vector<methods::VisibleReflector>& reflectors) override;

  ReferenceMaps maps_;
  MapChoice choice_;
  std::vector<MapPair> pair_of_object_;
  BlendedMapsBlock blended_;
};

}  // namespace parvis::reference_maps
