// What a mirror shows in a mirror: surfaces that mirror the sky alone, where twice_virtual_vertices.vert has
// put them.
#include "graphics/render/surface.frag"
#include "reflections/reflector_maps/patch_uniforms.glsl"
#include "reflections/virtual_objects/mirrored_triangle.glsl"

in float certainty;
in float height;
in vec3 shown_by;
in vec3 seen_first_from;
in vec3 shown_first_by;
in float height_of_second;

// For a concave mirror, whose layers hold the corners of a triangle in different images: the pixel must lie
// in one.
bool mirrors(int by, vec3 from, vec3 at_mirror, vec3 to) {
  mirror = by;
  if (patch_layer < 0) return true;
  return is_mirrored(moved(reflector_from_world, from), moved(reflector_from_world, at_mirror),
                     moved(reflector_from_world, to));
}

bool is_mirrored_here() {
  return is_shown_whole(certainty, height, shown_by) &&
         is_shown_whole(certainty, height_of_second, shown_first_by) &&
         mirrors(0, viewer_position.xyz, seen_first_from, seen_from) &&
         mirrors(1, seen_first_from, seen_from, position);
}
