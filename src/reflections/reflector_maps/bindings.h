// The texture units of curved reflectors, mirrors and glass.
#pragma once

#include "reflections/methods/bindings.h"

namespace parvis::reflector_maps {

enum TextureUnit : GLuint {
  reflector_unit = methods::first_overlay_unit,  ///< the map of the reflector that is drawn
  second_reflector_unit,                         ///< of a mirror that the first shows
  near_picture_unit,
  glass_picture_unit,
  grid_table_unit,
  grid_results_unit
};

/// The uniform blocks of curved reflectors.
enum UniformBlock : GLuint {
  patch_view_block = methods::first_overlay_block,
  second_mirror_block,
  glass_light_block,
  refraction_block
};

}  // namespace parvis::reflector_maps
