// Where one mirror shows a vertex, for vertex shaders: and what virtual surfaces need to know of it.
#include "reflections/virtual_objects/virtual_point.glsl"

out vec3 seen_from;
out float certainty;
out vec3 shown_by;
out float height;

// Hands on a point that shows a vertex in the mirror's frame; the image, in the world.
vec3 place_of(VirtualPoint point, vec3 vertex) {
  certainty = point.certainty;
  height = point.certainty == sure ? dot(vertex - point.seen_from, point.shown_by)
                                   : 0.0f;  // leaves it to the sure ones
  shown_by = point.shown_by;
  seen_from = moved(world_from_reflector, point.seen_from);
  return moved(world_from_reflector, point.image);
}

// Of a vertex in the world, searched for.
vec3 virtual_place(vec3 viewer, vec3 vertex) {
  vec3 in_mirror = moved(reflector_from_world, vertex);
  return place_of(virtual_point(moved(reflector_from_world, viewer), in_mirror), in_mirror);
}
