// All virtual grids of a scene in one texture, as VertexSearch lays them out: for each grid its origin, its
// cells per metre, its count of cells, its corners (their count stands beside the origin), then the numbers
// of the corners by their place in the grid's box, four to a texel; a place without a corner holds -1. Grids
// that are all vertices of a mesh have corners alone.
#include "reflections/virtual_objects/grid_sizes.glsl"

uniform highp sampler2D grid_table;

vec4 grid_texel(int texel) {
  return texelFetch(grid_table, ivec2(texel & (table_width - 1), texel / table_width), 0);
}

int corner_count(int grid) { return int(grid_texel(grid).w); }

vec3 corner_position(int grid, int corner) { return grid_texel(grid + grid_header_texels + corner).xyz; }

int corner_at(int grid, int place_in_box) {
  int numbers = grid + grid_header_texels + corner_count(grid);
  return int(grid_texel(numbers + place_in_box / numbers_per_texel)[place_in_box & (numbers_per_texel - 1)]);
}
