// A patch of a second reflector as the first shows it.
#include "reflections/virtual_objects/virtual_place.glsl"

layout(location = 0) in vec3 reflector_position;

uniform mat4 clip_from_world;
uniform mat4 world_from_second;
uniform vec3 viewer_in_world;

out vec3 at_second;  // in the world

void main() {
  at_second = moved(world_from_second, reflector_position);
  gl_Position = clip_from_world * vec4(virtual_place(viewer_in_world, at_second), 1.0f);
}
