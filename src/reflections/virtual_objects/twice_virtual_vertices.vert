// Where a first mirror shows each vertex of the scene as a second one shows it: two_bounce_search.glsl. The
// second's virtual vertex is mirrored once more, in the plane that touches the first.
#include SURFACE_VERTEX "graphics/render/surface_vertex.glsl"
#include "reflections/virtual_objects/virtual_place.glsl"

void turn_to(int to) { mirror = to; }

vec3 across(vec3 point, int to) {
  return moved(reflectors_from_world[to], moved(world_from_reflectors[1 - to], point));
}

#include "reflections/reflection_search/two_bounce_search.glsl"

#include "reflections/virtual_objects/second_mirror_block.glsl"

out vec3 seen_first_from;
out vec3 shown_first_by;
out float height_of_second;  // above the first

void main() {
  surface_vertex();
  turn_to(0);
  ReflectionTask first = ReflectionTask(moved(reflector_from_world, viewer_position.xyz),
                                        moved(reflector_from_world, second_middle.xyz), map_centre);
  PatchKind first_kind = patch_kind_of_mirror();
  turn_to(1);
  ReflectionTask second = ReflectionTask(vec3(0.0f), moved(reflector_from_world, position), map_centre);
  PatchKind second_kind = patch_kind_of_mirror();
  TwoBounces found =
      search_two_bounces(first, first_kind, patch_layers[0], second, second_kind, patch_layers[1]);
  ReflectionPoint near = found.first.point, far = found.second.point;
  certainty = has_place(found.first, first_kind) && has_place(found.second, second_kind) ? sure : lost;
  height = dot(second.vertex - far.position, far.normal);
  shown_by = far.normal;
  seen_from = moved(world_from_reflector, far.position);
  height_of_second = dot(across(far.position, 0) - near.position, near.normal);
  shown_first_by = near.normal;
  vec3 image = across(virtual_vertex(second.vertex, far.position, far.normal), 0);
  turn_to(0);
  seen_first_from = moved(world_from_reflector, near.position);
  image = virtual_vertex(image, near.position, near.normal);
  if (certainty == lost) image = map_centre;  // finite; the triangle is not drawn
  gl_Position = clip_from_world * vec4(moved(world_from_reflector, image), 1.0f);
}
