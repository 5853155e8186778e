// Of a captured facade: a corner, and which layers hold its triangle.
#include "graphics/render/frame.glsl"
#include "graphics/render/surface_outputs.glsl"

layout(location = 0) in vec3 facade_corner;
layout(location = 1) in vec3 facade_normal;
layout(location = 2) in vec3 corner_fallback;
layout(location = 3) in uvec2 triangle_candidates;
layout(location = 4) in float surface_lit;  // logarithm of a luminance: encoded_luminance / 255

uniform mat4 world_from_facade;
uniform int facade_thing;

out vec3 position_in_facade;
out vec3 fallback_colour;
flat out float lit_luminance;
flat out uvec2 candidates;  // the first, and how many

void surface_vertex() {
  position = (world_from_facade * vec4(facade_corner, 1.0f)).xyz;
  vertex_normal = (world_from_facade * vec4(facade_normal, 0.0f)).xyz;
  uv = vec2(0.0f);
  object_of_surface = facade_thing;
  position_in_facade = facade_corner;
  fallback_colour = corner_fallback;
  candidates = triangle_candidates;
  float bits = 255.0f * surface_lit;
  lit_luminance = bits < 0.5f ? 0.0f : exp2((bits - 1.0f) * (16.0f / 254.0f) - 10.0f);
}
