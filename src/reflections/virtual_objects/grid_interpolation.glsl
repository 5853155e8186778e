// Virtual vertices out of the eight corners of their cell (Estalella and others 2005, section 5), trilinear.
// Needs virtual_point.glsl and grid_table.glsl.
#include "reflections/virtual_objects/grid_cells.glsl"

uniform highp sampler2DArray grid_results;  // of vertex_search.frag

// Of a corner, or of a vertex that is one, as it was searched for.
VirtualPoint searched_point(int corner, int first_row) {
  ivec2 texel = ivec2(corner & (results_width - 1), first_row + corner / results_width);
  vec4 shown = texelFetch(grid_results, ivec3(texel, 0), 0);
  return VirtualPoint(shown.xyz, texelFetch(grid_results, ivec3(texel, 1), 0).xyz,
                      texelFetch(grid_results, ivec3(texel, 2), 0).xyz, shown.w);
}

struct InterpolatedPoint {
  VirtualPoint point;  // lost where a corner is not sure, and where places that face too far apart show them
  bool is_between_lost;  // all corners are: so is what lies between
};

// Of a vertex of a mesh, in the mesh's frame; `first_row` holds the grid's first corners.
InterpolatedPoint interpolated_point(int grid, int first_row, vec3 vertex) {
  const float min_agreement = 0.95f;
  vec4 origin = grid_texel(grid);
  vec3 place = position_in_cells(vertex, origin.xyz, grid_texel(grid + 1).xyz);
  ivec3 count = ivec3(grid_texel(grid + 2).xyz);
  ivec3 cell = cell_around(place, count);
  vec3 part = place - vec3(cell);
  vec4 image = vec4(0.0f);
  vec3 seen_from = vec3(0.0f), shown_by = vec3(0.0f);
  for (int i = 0; i < 8; ++i) {
    ivec3 far = ivec3(i & 1, (i >> 1) & 1, i >> 2);
    int corner = corner_at(grid, index_in_box(cell + far, count));
    vec3 shares = mix(1.0f - part, part, vec3(far));
    float share = shares.x * shares.y * shares.z;
    VirtualPoint point = searched_point(corner, first_row);
    image += vec4(share * point.image, point.certainty);
    seen_from += share * point.seen_from;
    shown_by += share * point.shown_by;
  }
  bool is_sure = image.w == sure && dot(shown_by, shown_by) >= min_agreement;
  return InterpolatedPoint(VirtualPoint(image.xyz, seen_from, normalize(shown_by), is_sure ? sure : lost),
                           image.w >= 8.0f * lost);
}
