// A patch of a reflector where it stands in a frame.
#pragma once

#include <optional>
#include <span>

#include "graphics/render/view.h"
#include "reflections/reflector_maps/gpu_reflector.h"

namespace parvis::reflector_maps {

/// Angles stay as they are; else normals of the maps would be wrong.
bool is_scaled_evenly(const glm::mat4& world_from_reflector);

glm::vec3 in_reflector(const glm::mat4& world_from_reflector, glm::vec3 point);

struct ShownPatch {
  int object;
  int near;  ///< the list of objects that stand near, all that it is to show; below 0: all objects
  const GpuReflector* reflector;
  const GpuReflector::Patch* patch;
  glm::mat4 world_from_reflector;
  glm::vec3 viewer;  ///< in the reflector's frame
};

/// What to draw a patch in: layers, as patch_search.glsl numbers them; from the first up to the end.
struct Layers {
  int first, end;
};
Layers layers_of(const GpuReflector::Patch& patch);

/// Is any of the patches one of this object?
bool is_shown(std::span<const ShownPatch> patches, int object);

/// The rectangle of the view, from the lower left, that holds all of a patch's pixels.
glm::ivec4 pixels_of(const ShownPatch& patch, const render::View& view);

/// Between them what is drawn changes, where it is nearest, the stencil, too. Its colour is that of a patch
/// that shows nothing yet (patch_pixels.frag).
void begin_marks(const render::View& view);
void end_marks();

/// Each pixel of the view's stencil gets the number of the nearest patch there, counted from 1; or all of
/// them get `number`. What was marked before stays where it is nearer. `patch_pixels`: patch_pixels.vert and
/// .frag. The view's stencil test is on.
void mark_patches(const gl::Program& patch_pixels, const render::View& view,
                  std::span<const ShownPatch> patches, std::optional<int> number = {});

}  // namespace parvis::reflector_maps
