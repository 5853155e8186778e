// Which texture unit and uniform block each name in the shaders of this room stands for. (GLSL ES 3.00 cannot
// say so itself.)
#pragma once

#include "graphics/gl/program.h"

namespace parvis::render {

/// Texture units of the surface shaders: this room's, those of rooms that shade surfaces, those of rooms that
/// draw surfaces by themselves (who may use the first four, too). GLSL ES 3.00 has 32 at least.
enum TextureUnit : GLuint {
  base_colour_unit,
  normal_unit,
  surface_unit,
  emission_unit,
  sky_unit,
  shadow_unit,
  sky_visibility_unit,
  traced_sun_unit,
  lamp_table_unit,
  lamp_maps_unit,
  bounced_light_unit,
  vertex_light_unit,
  inserted_shadow_unit,
  occlusion_unit,
  first_unit_above,
  first_drawable_unit = 24
};

/// Bindings of uniform blocks; rooms above take those from `first_block_above` on, rooms that draw surfaces
/// by themselves those from `first_drawable_block` on.
enum UniformBlock : GLuint {
  frame_block,
  material_block,
  bodies_block,
  first_block_above,
  first_drawable_block = 12
};

/// Assigns units and blocks; called once for each program that includes frame.glsl, material.glsl,
/// body_lookup.glsl, sky_lookup.glsl or sun_lookup.glsl. What the program lacks of them is left out.
inline void assign_bindings(const gl::Program& program) {
  constexpr const char* samplers[]{
      "base_colour_texture",  "normal_texture",   "surface_texture",        "emission_texture",
      "sky_texture",          "shadow_maps",      "sky_visibility_texture", "traced_sun_texture",
      "lamp_table",           "lamp_maps",        "bounced_light_texture",  "vertex_light_texture",
      "inserted_shadow_maps", "occlusion_texture"};
  for (GLuint unit = 0; unit < first_unit_above; ++unit)
    if (program.declares(samplers[unit])) program.set(samplers[unit], int(unit));
  constexpr const char* blocks[]{"Frame", "Material", "Bodies"};
  for (GLuint binding = 0; binding < first_block_above; ++binding)
    if (const GLuint index = glGetUniformBlockIndex(program.name(), blocks[binding]);
        index != GL_INVALID_INDEX)
      glUniformBlockBinding(program.name(), index, binding);
}

}  // namespace parvis::render
