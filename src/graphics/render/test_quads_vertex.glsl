// Of test_quads.h: a quad where a matrix puts it.
#include "graphics/render/frame.glsl"
#include "graphics/render/surface_outputs.glsl"

layout(location = 0) in vec3 quad_position;

uniform mat4 world_from_quad;
uniform int quad_object;

void surface_vertex() {
  position = (world_from_quad * vec4(quad_position, 1.0f)).xyz;
  vertex_normal = (world_from_quad * vec4(0.0f, 0.0f, 1.0f, 0.0f)).xyz;
  uv = 0.5f * quad_position.xy + 0.5f;
  object_of_surface = quad_object;
}
