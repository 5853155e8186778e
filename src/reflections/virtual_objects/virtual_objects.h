// Reflections on curved objects by virtual objects (Estalella and others 2005): for each patch of each
// reflector the scene is drawn once more, every vertex at its virtual position, into an image that the
// reflector's pixels look up: reflection(method="virtual_objects"). Or only nearby objects:
// reflection(virtual_within=...), over another method.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "reflections/methods/reflections.h"
#include "reflections/reflector_maps/near_objects.h"
#include "reflections/reflector_maps/settings.h"
#include "reflections/reflector_maps/virtual_picture.h"
#include "reflections/virtual_objects/mirrors_in_mirrors.h"
#include "reflections/virtual_objects/vertex_search.h"

namespace parvis::virtual_objects {
using namespace reflection_search;
using namespace reflector_maps;

/// Reflectors by model; null: the model's mesh cannot be used as a reflector.
using ReflectorsByModel = std::unordered_map<const scene::Model*, std::unique_ptr<GpuReflector>>;

/// The overlay that renders virtual objects, and the vertex shader's search for it.
class VirtualObjects final : public methods::Overlay, public render::VirtualVertices {
 public:
  /// Builds the maps of all reflecting objects; reports defects of their meshes on standard error. Objects
  /// whose mesh cannot be used reflect the sky alone. `surroundings` is shown where there is no virtual
  /// object; null: the sky.
  static Result<std::unique_ptr<VirtualObjects>> create(const scene::Scene& scene, render::Renderer& renderer,
                                                        std::unique_ptr<methods::Reflections> surroundings);

  render::SurfaceSource source() const override;
  void bind(const gl::Program& program, int object) override;
  void bind(const gl::Program& program) override;
  bool may_show(const Bounds& bounds) const override;
  glm::ivec2 add(const render::Item& item) override;
  void prepare() override;

 private:
  VirtualObjects(const scene::Scene& scene, ReflectorsByModel reflectors, render::SurfacePrograms programs,
                 gl::Program patch_pixels, gl::Program own_reflection, VirtualPicture picture,
                 VertexSearch vertex_search, std::unique_ptr<MirrorsInMirrors> in_mirrors,
                 std::unique_ptr<methods::Reflections> surroundings);
  void update_maps(render::Renderer& renderer, const scene::Scene& scene,
                   const std::vector<methods::VisibleReflector>& reflectors) override;

  void follow_objects(const scene::Scene& scene);
  /// Those that the main view may see.
  void find_patches(const render::Renderer& renderer,
                    const std::vector<methods::VisibleReflector>& reflectors);
  void find_all_patches(const render::Renderer& renderer);
  void leave_out_small(const render::Renderer& renderer);
  void flag_near_objects();
  void draw_own_reflections(const render::View& view);
  void draw_patch(render::Renderer& renderer, const ShownPatch& patch, render::View view);

  ReflectorsByModel reflectors_;
  std::vector<const scene::Model*> model_of_object_;
  std::vector<glm::vec3> colour_of_object_;  ///< of its mirrors
  gl::Program patch_pixels_, own_reflection_;
  PatchViewBlock patch_view_;
  VirtualPicture picture_;
  VertexSearch vertex_search_;
  std::unique_ptr<MirrorsInMirrors> in_mirrors_;  ///< null: they show the sky
  bool uses_level_of_detail_, shows_all_;
  float within_m_;
  std::vector<ShownPatch> shown_;  ///< in the order of their numbers in the stencil
  std::vector<ShownPatch> all_;    ///< whether the main view shows them or not
  NearObjects near_;
  std::vector<std::vector<std::uint8_t>> large_;  ///< by reflector: objects that its surroundings show
  std::vector<methods::VisibleReflector> below_reflectors_;  ///< as the method below is to show them
  const ShownPatch* current_ = nullptr;                      ///< while its mirrored view is drawn
  float pixels_per_radian_ = 0.0f;                           ///< of the main view
  int layer_ = -1;                                           ///< of it, if it may show a vertex several times
};

/// See VirtualObjects::create; scene and renderer must outlive it.
Result<std::unique_ptr<methods::Reflections>> make_virtual_objects(
    const scene::Scene& scene, render::Renderer& renderer,
    std::unique_ptr<methods::Reflections> surroundings = nullptr);

}  // namespace parvis::virtual_objects
