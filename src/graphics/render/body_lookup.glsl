// The bodies that move near the viewer, and their shade: block at binding 2, filled by render/renderer.cpp.
#include "graphics/shading/body_shade.glsl"

layout(std140) uniform Bodies {
  vec4 body_grid;
  uvec4 body_cells[body_cells_a_side * body_cells_a_side / 4];
  Body bodies[most_bodies];
};

#include "graphics/shading/body_shade_lookup.glsl"
