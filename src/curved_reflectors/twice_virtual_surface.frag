// What a mirror shows in a mirror: surfaces that mirror the sky alone, where twice_virtual_vertices.vert has put them.
#include "render/surface.frag"
#include "curved_reflectors/mirrored_triangle.glsl"

in float doubt;
in float height;
in vec3 shown_by;
in vec3 shown_first_by;
in float height_of_second;

bool is_mirrored_here() {
  return is_shown_whole(doubt, height, shown_by) && is_shown_whole(doubt, height_of_second, shown_first_by);
}
