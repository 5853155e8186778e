// Mirrors seen in mirrors (Estalella and others 2005, section 8, "multiple reflections"): for each pair of
// patches the scene is drawn with every vertex at its position after both reflections
// (two_bounce_search.glsl), into the pixels in which the first patch shows the second.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "graphics/render/renderer.h"
#include "reflections/reflector_maps/shown_patch.h"
#include "reflections/reflector_maps/virtual_picture.h"

namespace parvis::virtual_objects {
using namespace reflection_search;
using namespace reflector_maps;
namespace second_mirror_shared {
using namespace parvis::shading;
#include "reflections/virtual_objects/second_mirror_block.glsl"
}  // namespace second_mirror_shared

/// Renders the second reflections of a frame into one image.
class MirrorsInMirrors final : public render::VirtualVertices {
 public:
  /// `map_defines`: for map_window.glsl. Fails only if a shader does not compile.
  static Result<std::unique_ptr<MirrorsInMirrors>> create(const render::Renderer& renderer,
                                                          gl::Defines map_defines);

  /// Draws all pairs. `first`: patches in the main view, ordered by size; `second`: all patches. Of each,
  /// those after the first fifteen are left out, and a concave mirror in a concave one.
  void draw(render::Renderer& renderer, const gl::Program& patch_pixels, std::span<const ShownPatch> first,
            std::span<const ShownPatch> second);
  /// The image: as large as the main view, coverage in alpha.
  GLuint texture() const { return picture_.texture(); }

  void bind(const gl::Program& program) override;
  bool may_show(const Bounds& bounds) const override { return !bounds.empty(); }

 private:
  MirrorsInMirrors(render::SurfacePrograms programs, gl::Program mirrored_patch, VirtualPicture picture);
  void find_seconds(const ShownPatch& first, std::span<const ShownPatch> second);
  void mark_seconds(const render::View& view, int first_number);
  void draw_layers(render::Renderer& renderer, render::View view);

  static constexpr std::size_t maximum = 15;  ///< of each kind: their numbers share a stencil of eight bits

  gl::Program mirrored_patch_;
  gl::UniformBlock<second_mirror_shared::SecondMirror> second_mirror_{"SecondMirror", second_mirror_block};
  VirtualPicture picture_;
  std::array<gl::Query, maximum> is_seen_;  ///< by number of the second
  std::vector<ShownPatch> firsts_, seconds_;
  std::vector<std::pair<float, const ShownPatch*>> candidates_;
  const ShownPatch *first_ = nullptr, *second_ = nullptr;  ///< while they are drawn
  int first_layer_ = -1, second_layer_ = -1;
};

}  // namespace parvis::virtual_objects
