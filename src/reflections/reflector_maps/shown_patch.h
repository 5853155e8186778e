// A patch of a reflector with its pose in the present frame.
#pragma once

#include <optional>
#include <span>

#include "graphics/gl/uniform_block.h"
#include "graphics/render/view.h"
#include "graphics/shading/glsl.h"
#include "reflections/reflector_maps/bindings.h"
#include "reflections/reflector_maps/gpu_reflector.h"

namespace parvis::reflector_maps {

namespace patch_view_shared {
using namespace parvis::shading;
#include "reflections/reflector_maps/patch_view_block.glsl"
}  // namespace patch_view_shared

/// True for a uniform scale without mirroring: the transform keeps angles, so that the maps' normals stay
/// valid.
bool is_scaled_evenly(const glm::mat4& world_from_reflector);

/// Transforms a point from the world into the reflector's frame.
glm::vec3 in_reflector(const glm::mat4& world_from_reflector, glm::vec3 point);

/// A patch that the main view shows.
struct ShownPatch {
  int object;
  int near;  ///< index of the list of nearby objects that it shows; negative: it shows all objects
  const GpuReflector* reflector;
  const GpuReflector::Patch* patch;
  glm::mat4 world_from_reflector;
  glm::vec3 viewer;  ///< in the reflector's frame
};

/// The uniform block of a patch that is drawn where the view shows it.
class PatchViewBlock {
 public:
  /// Hands a program the patch as a view shows it, and the reflectance of its mirror.
  void bind(const gl::Program& program, const ShownPatch& patch, const glm::mat4& clip_from_world,
            glm::vec3 mirror_colour = glm::vec3(1.0f)) const {
    block_.bind(program, {.clip_from_reflector = clip_from_world * patch.world_from_reflector,
                          .viewer_in_reflector = glm::vec4(patch.viewer, 1.0f),
                          .mirror_colour = glm::vec4(mirror_colour, 1.0f)});
  }

 private:
  gl::UniformBlock<patch_view_shared::PatchView> block_{"PatchView", patch_view_block};
};

/// Range of layers in which a patch is drawn, numbered as in patch_search.glsl; `end` is excluded.
struct Layers {
  int first, end;
};
/// The layers of a patch: one without a number (-1) if it shows every vertex at most once.
Layers layers_of(const GpuReflector::Patch& patch);

/// True if one of the patches belongs to this object.
bool is_shown(std::span<const ShownPatch> patches, int object);

/// Bounding rectangle of a patch's pixels in the view: x, y, width, height from the lower left.
glm::ivec4 pixels_of(const ShownPatch& patch, const render::View& view);

/// Starts drawing marks: the nearest fragment writes the stencil. Its colour is that of a patch that shows
/// nothing yet (patch_pixels.frag).
void begin_marks(const render::View& view);
/// Ends it: the stencil is only tested from now on.
void end_marks();

/// Writes the number of the nearest patch, counted from 1, into each pixel of the view's stencil; or `number`
/// for all patches. Earlier marks stay where they are nearer. `patch_pixels` is linked from patch_pixels.vert
/// and .frag; the stencil test must be enabled.
void mark_patches(const gl::Program& patch_pixels, const render::View& view,
                  std::span<const ShownPatch> patches, std::optional<int> number = {});

}  // namespace parvis::reflector_maps
