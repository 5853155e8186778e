// Which texture unit and block each name in the shaders of this room stands for. (GLSL ES 3.00 cannot say so
// itself.)
#pragma once

#include "graphics/gl/program.h"

namespace parvis::render {

inline constexpr GLuint sky_unit = 4;
inline constexpr GLuint shadow_unit = 5;
inline constexpr GLuint first_reflection_unit = 6;  ///< to 12, for the rooms above
inline constexpr GLuint near_picture_unit = 13;     ///< of the method that draws what stands near
inline constexpr GLuint virtual_vertex_unit = 14;   ///< of the room that places virtual vertices
inline constexpr GLuint glass_picture_unit = 14;    ///< in the main view, which has no virtual vertices
inline constexpr GLuint sky_visibility_unit = 15;
inline constexpr GLuint grid_table_unit = 16, grid_results_unit = 17;  ///< of virtual grids
inline constexpr GLuint first_drawable_unit = 18;  ///< and all above: of what rooms draw by themselves

/// To be called once for each program that includes frame.glsl, material.glsl, body_lookup.glsl,
/// sky_lookup.glsl or sun_lookup.glsl.
inline void assign_bindings(const gl::Program& program) {
  constexpr const char* samplers[]{"base_colour_texture", "normal_texture", "surface_texture",
                                   "emission_texture",    "sky_texture",    "shadow_maps"};
  for (int unit = 0; unit < 6; ++unit) program.set(samplers[unit], unit);
  program.set("near_picture", int(near_picture_unit));
  program.set("glass_picture", int(glass_picture_unit));
  program.set("sky_visibility_texture", int(sky_visibility_unit));
  constexpr const char* blocks[]{"Frame", "Material", "Bodies"};
  for (GLuint binding = 0; binding < 3; ++binding)
    if (const GLuint index = glGetUniformBlockIndex(program.name(), blocks[binding]);
        index != GL_INVALID_INDEX)
      glUniformBlockBinding(program.name(), index, binding);
}

}  // namespace parvis::render
