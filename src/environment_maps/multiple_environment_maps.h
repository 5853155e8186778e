// Multiple environment maps, pixel by pixel: each reflecting pixel traces its own ray through the city's
// heights and looks the point that it meets up in the reference maps that see it. No map is drawn for a
// reflector, so that a hundred cars cost what their pixels cost, and a body shows the parallax that a map
// with one centre lacks.
#pragma once

#include "environment_maps/height_pyramid.h"
#include "environment_maps/map_renewal.h"
#include "environment_maps/mirrored_bodies.h"
#include "render/reflections.h"

namespace parvis::environment_maps {

/// Makes the method for a scene and hands it to the renderer: bakes the reference maps, which takes some
/// seconds.
Result<std::unique_ptr<render::Reflections>> make_reflections(const scene::Scene& scene,
                                                              render::Renderer& renderer);

class MultipleEnvironmentMaps final : public render::Reflections {
 public:
  static Result<std::unique_ptr<MultipleEnvironmentMaps>> create(const scene::Scene& scene,
                                                                 render::Renderer& renderer);

  std::string fragment_shader() const override { return "environment_maps/multiple_environment_maps.frag"; }
  void bind(const gl::Program& program, int object) override;

  const ReferenceMaps& maps() const { return maps_; }

 private:
  MultipleEnvironmentMaps(const scene::Scene& scene, const HeightPyramid& heights, ReferenceMaps maps,
                          MapRenewal renewal);
  void update_maps(render::Renderer& renderer, const scene::Scene& scene,
                   const std::vector<render::Reflector>& reflectors) override;
  void forget_surroundings() override { renewal_.ask(maps_.places().size()); }

  ReferenceMaps maps_;
  MapRenewal renewal_;
  MirroredBodies bodies_;
  glm::vec2 origin_;
  float cell_m_;
  glm::ivec2 cells_;
  int top_level_;
  glm::vec3 choice_grid_;  ///< south-west corner and metres a cell
  gl::Texture heights_, choice_;
};

}  // namespace parvis::environment_maps
