// Refraction through bodies of solid glass, over any reflection method: an image as large as the main view
// that their pixels look up. The background is the cube map of the glass's surroundings, if the method has
// one, else the sky. In front of it, where virtual objects are requested
// (reflection(method="virtual_objects") or virtual_within), the scene is drawn once more with every vertex at
// its refracted position (refraction_search.glsl). Glass that refraction cannot handle is drawn as a pane:
// the scene straight through it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "reflections/methods/reflections.h"
#include "reflections/reflector_maps/near_objects.h"
#include "reflections/reflector_maps/reflector_cache.h"
#include "reflections/reflector_maps/settings.h"
#include "reflections/reflector_maps/shown_patch.h"
#include "reflections/reflector_maps/virtual_picture.h"
#include "reflections/refraction/refraction_search.h"

namespace parvis::refraction {
using namespace reflection_search;
using namespace reflector_maps;
namespace refraction_shared {
using namespace parvis::shading;
#include "reflections/refraction/glass_light_block.glsl"
#include "reflections/refraction/refraction_block.glsl"
}  // namespace refraction_shared

/// The overlay that renders refraction, and the vertex shader's search for it.
class RefractedObjects final : public methods::Overlay, public render::VirtualVertices {
 public:
  /// Builds the maps of all bodies of glass; reports on standard error those that refraction cannot handle
  /// (open, not convex): they are drawn as panes. `reflections` is the method that surfaces reflect by.
  static Result<std::unique_ptr<RefractedObjects>> create(const scene::Scene& scene,
                                                          const render::Renderer& renderer,
                                                          std::unique_ptr<methods::Reflections> reflections);

  render::SurfaceSource source() const override;
  void bind(const gl::Program& program, int object) override;
  void bind(const gl::Program& program) override;
  bool may_show(const Bounds& bounds) const override;

 private:
  struct Glass {
    GpuReflector gpu;                 ///< all of its surface as one patch
    std::optional<ReflectorMap> map;  ///< none: light can not be followed through it
    float ior;
    glm::vec3 absorption_per_m;
    std::vector<std::size_t> parts;  ///< of its model
    float thickness = 0.0f;          ///< in its model's unit, as a pane
  };
  /// State per frame of a body of glass, beside its patch.
  struct ViewThrough {
    const Glass* glass = nullptr;
    bool shows_objects = false;                        ///< before the light of its surroundings
    std::array<glm::mat4, refraction_ray_count> rays;  ///< if it shows objects
  };

  RefractedObjects(const scene::Scene& scene, render::SurfacePrograms programs, gl::Program patch_pixels,
                   gl::Program glass_light, VirtualPicture picture,
                   std::unique_ptr<methods::Reflections> reflections);
  static std::optional<Glass> glass_of(const ReflectorCache& cache, const GlassSource& source);
  void update_maps(render::Renderer& renderer, const scene::Scene& scene,
                   const std::vector<methods::VisibleReflector>& reflectors) override;
  void find_glass(const render::Renderer& renderer, const std::vector<methods::VisibleReflector>& reflectors);
  void find_bodies(const render::Renderer& renderer, int object, const std::vector<Glass>& bodies);
  void draw_through(render::Renderer& renderer, std::size_t i, render::View view);
  void draw_panes(render::Renderer& renderer, render::View view);
  void draw_light(const render::View& view, std::size_t i, int part) const;  // of glass_light_part.glsl

  std::unordered_map<const scene::Model*, std::vector<Glass>> glass_;
  std::vector<const scene::Model*> model_of_object_;
  gl::Program patch_pixels_, glass_light_;
  PatchViewBlock patch_view_;
  gl::UniformBlock<refraction_shared::GlassLight> light_{"GlassLight", glass_light_block};
  gl::UniformBlock<refraction_shared::Refraction> refraction_{"Refraction", refraction_block};
  VirtualPicture picture_;
  bool shows_all_;
  float within_m_;
  std::vector<ShownPatch> shown_;     ///< in the order of their numbers in the stencil
  std::vector<ViewThrough> through_;  ///< of each of them
  std::vector<ShownPatch> panes_;     ///< bodies that light is not followed through
  std::vector<const Glass*> glass_of_panes_;
  NearObjects near_;
  std::vector<std::uint32_t> own_items_;  ///< of the body whose mirrored view is drawn
  std::size_t current_ = 0;               ///< of them, while its mirrored view is drawn
  int foci_ = 0;                          ///< that the light of its layer has passed
};

/// See RefractedObjects::create; scene and renderer must outlive it.
Result<std::unique_ptr<methods::Reflections>> make_refracted_objects(
    const scene::Scene& scene, render::Renderer& renderer, std::unique_ptr<methods::Reflections> reflections);

}  // namespace parvis::refraction
