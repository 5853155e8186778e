// A patch of a second reflector as the first shows it.
#include "reflections/virtual_objects/virtual_place.glsl"

layout(location = 0) in vec3 reflector_position;

#include "reflections/virtual_objects/second_mirror_block.glsl"

out vec3 at_second;  // in the world

void main() {
  at_second = moved(world_from_second, reflector_position);
  gl_Position = clip_of_view * vec4(virtual_place(viewer_in_world.xyz, at_second), 1.0f);
}
