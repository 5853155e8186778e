// Multiple environment maps, per pixel (Meyer and Loscos 2003, sections 4.1 to 4.3): each reflecting pixel
// traces its mirror ray through the city's height field and looks the hit point up in the reference maps that
// see it. No map is rendered per reflector, so the cost of a hundred cars is that of their pixels, and
// reflections have the parallax that a map with one centre lacks.
#pragma once

#include <array>
#include <optional>
#include <set>

#include "graphics/gl/uniform_block.h"
#include "graphics/render/quality_budget.h"
#include "reflections/environment_rays/map_table.h"
#include "reflections/environment_rays/mirrored_bodies.h"
#include "reflections/methods/bindings.h"
#include "reflections/methods/light_jump.h"
#include "reflections/methods/mirror_picture.h"
#include "reflections/methods/reflections.h"
#include "reflections/reference_maps/height_pyramid.h"
#include "reflections/reference_maps/map_cache.h"
#include "reflections/reference_maps/map_keeper.h"
#include "reflections/reference_maps/map_renewal.h"
#include "reflections/reference_maps/place_search.h"

namespace parvis::environment_rays {
#include "reflections/environment_rays/ray_detail.glsl"
namespace map_block {
using namespace parvis::shading;
#include "reflections/environment_rays/map_block.glsl"
}  // namespace map_block
using namespace reference_maps;

/// Creates the method for a scene. A reference map is read, or drawn if it is not baked, when a reflector
/// first looks into it: for a picture or a film's frame all of them, in a window at most one is drawn per
/// frame, and kept. As many are held as ReferenceMaps::max_count allows. With methods::Pace::begins_at_once
/// a few maps, evenly spread, serve until all have their places. Errors: a shader; the driver has no memory
/// for the maps.
Result<std::unique_ptr<methods::Reflections>> make_multiple_environment_maps(
    const scene::Scene& scene, render::Renderer& renderer,
    std::unique_ptr<methods::Reflections> below = nullptr);

/// The method's maps, textures and shaders.
class MultipleEnvironmentMaps final : public methods::Reflections {
 public:
  /// See make_multiple_environment_maps; scene and renderer must outlive it.
  static Result<std::unique_ptr<MultipleEnvironmentMaps>> create(const scene::Scene& scene,
                                                                 render::Renderer& renderer);

  render::SurfaceSource source() const override {
    return {.fragment = "reflections/methods/mirror_picture.frag"};
  }
  void frame_took(double update_ms, double rest_ms) override { budget_.frame_took(update_ms, rest_ms); }
  void prefer_rate() override { prefers_rate_ = true; }
  void hold(double budget_ms) override { budget_.set_budget(budget_ms); }
  bool supply(render::Renderer& renderer, const scene::Scene& scene) override;
  void bind(const gl::Program& program, int object) override;

  const ReferenceMaps& maps() const { return maps_; }  ///< those that are held, each as drawn last
  std::size_t drawn_maps() const { return table_.drawn_layers().size(); }  ///< how many hold something
  /// Whether the maps stand where they stay; else a few, evenly spread, serve meanwhile.
  bool is_placed() const { return !search_; }

  /// Level of detail (ray_detail.glsl) at which an object was shaded last.
  int detail_of(int object) const { return details_[std::size_t(object)]; }

 private:
  /// A shader for each detail: software runs both sides of a branch.
  using Programs = std::array<gl::Program, detail_count>;

  MultipleEnvironmentMaps(const scene::Scene& scene, const HeightPyramid& heights, MapCache baked,
                          std::vector<glm::vec3> places, std::unique_ptr<PlaceSearch> search,
                          ReferenceMaps maps, MapRenewal renewal, methods::MirrorPicture picture,
                          Programs programs);
  int best_detail_for(const methods::VisibleReflector& reflector) const;
  std::span<const methods::VisibleReflector> with_smooth_outlines(
      const std::vector<methods::VisibleReflector>& reflectors) const;
  void choose_details(const render::Renderer& renderer,
                      const std::vector<methods::VisibleReflector>& reflectors);
  void prepare(const gl::Program& program) const;
  void update_maps(render::Renderer& renderer, const scene::Scene& scene,
                   const std::vector<methods::VisibleReflector>& reflectors) override;
  void begin_frame() override;
  void copy_baked();
  bool take_places(const scene::Scene& scene);
  void keep(const scene::Scene& scene, std::size_t map);
  void forget_surroundings() override;
  void forget_light();
  void find_missing_maps(const render::Renderer& renderer,
                         const std::vector<methods::VisibleReflector>& reflectors);

  bool uses_level_of_detail_;
  std::vector<int> details_;  ///< of each object
  render::QualityBudget budget_;
  std::vector<std::array<render::QualityLevel, detail_count>> qualities_;  ///< of each reflector
  std::vector<render::QualityWish> wishes_;
  std::vector<GLuint> prepared_;  ///< programs of surfaces that have this frame's textures
  methods::MirrorPicture picture_;
  Programs programs_;
  std::unique_ptr<PlaceSearch> search_;  ///< of all maps' places; null: they are found
  std::optional<MapCache> baked_;        ///< none: what is baked is out of date
  std::set<std::size_t> unbaked_;        ///< maps of which it holds none that can be read
  std::unique_ptr<MapKeeper> keeper_;    ///< from the first map on that a window draws
  ReferenceMaps maps_;
  MapRenewal renewal_;
  methods::LightJump light_jump_;
  MirroredBodies bodies_;
  glm::vec2 origin_;
  float cell_m_;
  glm::ivec2 cells_;
  int top_level_;
  MapTable table_;
  std::vector<std::size_t> wanted_;  ///< maps that the last frame's eyes looked into and that have no layer
  bool renews_one_ = false;          ///< no eye of this frame has renewed faces of maps yet
  /// A face takes a software renderer a twentieth of a second.
  int faces_per_frame_ = gl::is_software() ? 1 : methods::cube_faces;
  bool prefers_rate_ = false;  ///< draws at most one missing map per frame
  gl::Texture heights_;
  gl::UniformBlock<map_block::MapLayout> layout_{"MapLayout", methods::first_method_block + 1};
};

}  // namespace parvis::environment_rays
