// The vertices of one mesh, or the corners of its virtual grid, as a rectangle of a texel each: the texture's
// whole rows.
#include "reflections/virtual_objects/grid_table.glsl"

layout(location = 0) in vec4 world_from_mesh_row0;  // of each instance, as all here
layout(location = 1) in vec4 world_from_mesh_row1;
layout(location = 2) in vec4 world_from_mesh_row2;
layout(location = 3) in ivec2 grid_and_first_row;

uniform vec2 results_size;

flat out vec4 world_from_corner_row0;
flat out vec4 world_from_corner_row1;
flat out vec4 world_from_corner_row2;
flat out ivec2 grid_and_row;

void main() {
  world_from_corner_row0 = world_from_mesh_row0;
  world_from_corner_row1 = world_from_mesh_row1;
  world_from_corner_row2 = world_from_mesh_row2;
  grid_and_row = grid_and_first_row;
  float rows = ceil(float(corner_count(grid_and_first_row.x)) / results_size.x);
  float row = float(grid_and_first_row.y) + (gl_VertexID < 2 ? 0.0f : rows);
  gl_Position = vec4((gl_VertexID & 1) == 0 ? -1.0f : 1.0f, 2.0f * row / results_size.y - 1.0f, 0.0f, 1.0f);
}
