// Where a patch shows vertices, and corners of virtual grids (Estalella and others 2005, section 5): a texel
// each. In the reflector's frame; w of the image is how doubtful the point is.
#include "reflections/virtual_objects/virtual_point.glsl"
#include "reflections/virtual_objects/grid_table.glsl"

uniform vec2 results_size;
#include "reflections/reflector_maps/patch_view_block.glsl"

flat in vec4 world_from_corner_row0;
flat in vec4 world_from_corner_row1;
flat in vec4 world_from_corner_row2;
flat in ivec2 grid_and_row;

layout(location = 0) out vec4 image;
layout(location = 1) out vec4 seen_from;
layout(location = 2) out vec4 shown_by;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  int corner = (at.y - grid_and_row.y) * int(results_size.x) + at.x;
  if (corner >= corner_count(grid_and_row.x)) discard;
  vec4 p = vec4(corner_position(grid_and_row.x, corner), 1.0f);
  vec3 in_world =
      vec3(dot(world_from_corner_row0, p), dot(world_from_corner_row1, p), dot(world_from_corner_row2, p));
  VirtualPoint point = virtual_point(viewer_in_reflector.xyz, moved(reflector_from_world, in_world));
  image = vec4(point.image, point.certainty);
  seen_from = vec4(point.seen_from, 0.0f);
  shown_by = vec4(point.shown_by, 0.0f);
}
