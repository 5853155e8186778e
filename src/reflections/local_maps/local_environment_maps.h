// Local maps (Meyer and Loscos 2003, section 4.4): each reflecting body has its own environment map, computed
// for its position from the two reference maps between which it lies, and looked up like a cube map. Dynamic
// objects are drawn over it in a second pass (section 6).
#pragma once

#include <optional>

#include "reflections/local_maps/local_map_level.h"
#include "reflections/local_maps/local_map_picture.h"
#include "reflections/local_maps/local_map_slots.h"
#include "reflections/methods/reflections.h"
#include "reflections/methods/settings.h"
#include "reflections/reference_maps/map_pair.h"
#include "reflections/reference_maps/simple_blend.h"

namespace parvis::local_maps {
using namespace reference_maps;
namespace local_map_block {
using namespace parvis::shading;
#include "reflections/local_maps/local_map_block.glsl"
}  // namespace local_map_block

/// Creates the method for a scene; baking the reference maps takes a few seconds. Errors: a shader, or the
/// baking.
Result<std::unique_ptr<methods::Reflections>> make_local_environment_maps(
    const scene::Scene& scene, render::Renderer& renderer,
    std::unique_ptr<methods::Reflections> below = nullptr);

/// The method's reference maps and local maps.
class LocalEnvironmentMaps final : public methods::Reflections {
 public:
  /// See make_local_environment_maps; scene and renderer must outlive it.
  static Result<std::unique_ptr<LocalEnvironmentMaps>> create(const scene::Scene& scene,
                                                              render::Renderer& renderer);

  render::SurfaceSource source() const override {
    return {.fragment = "reflections/local_maps/local_environment_maps.frag"};
  }
  void bind(const gl::Program& program, int object) override;
  void frame_took(double update_ms, double rest_ms) override { budget_.frame_took(update_ms, rest_ms); }

  const ReferenceMaps& maps() const { return maps_; }          ///< from which local maps are computed
  const LocalMapPicture& picture() const { return picture_; }  ///< the texture of all local maps
  /// Place of an object's local map in that texture; empty if the object is shaded by simple blending, or was
  /// not visible.
  std::optional<LocalMapPlace> place_of(int object) const { return used_[std::size_t(object)].place; }

 private:
  /// The maps that a body looks up in this frame.
  struct Used {
    std::optional<LocalMapPlace> place;  ///< nothing: simply blended maps
    LocalMapLevel level;
    int rung = 0;  ///< of the ladder of levels that the budget chooses from
    MapPair pair;
    std::optional<glm::vec3> centre;  ///< in the frame in which it was seen last
  };
  /// A map to be drawn in this frame.
  struct Drawn {
    LocalMapPlace place;
    glm::vec3 centre;
    int object;
    bool shows_others;
  };
  LocalEnvironmentMaps(const scene::Scene& scene, HeightPyramid heights, ReferenceMaps maps,
                       LocalMapPicture picture);
  void update_maps(render::Renderer& renderer, const scene::Scene& scene,
                   const std::vector<methods::VisibleReflector>& reflectors) override;
  void forget_surroundings() override { slots_.forget(); }
  void choose_levels(const render::Renderer& renderer,
                     const std::vector<methods::VisibleReflector>& reflectors);
  void choose_map(const render::Renderer& renderer, const methods::VisibleReflector& reflector);
  LocalMapLevel best_level_of(const methods::VisibleReflector& reflector, float radius_m) const;
  void make_meshes();
  void draw_others(render::Renderer& renderer, const Drawn& drawn);

  methods::Settings settings_;
  HeightPyramid heights_;
  ReferenceMaps maps_;
  MapChoice choice_;
  LocalMapPicture picture_;
  LocalMapSlots slots_;
  render::QualityBudget budget_;
  std::vector<LevelLadder> ladders_;
  std::vector<render::QualityWish> wishes_;
  std::vector<Used> used_;  ///< of each object
  std::vector<Drawn> drawn_;
  std::vector<LocalMapPlace> drawn_places_;
  std::vector<std::uint8_t> others_;  ///< for each object: does it show in the map that is looked at?
  std::vector<FaceTask> tasks_;
  std::vector<FaceMesh> meshes_;  ///< as many as a frame ever needed
  BlendedMapsBlock blended_;
  gl::UniformBlock<local_map_block::LocalMap> local_{"LocalMap", methods::first_method_block + 1};
};

}  // namespace parvis::local_maps
