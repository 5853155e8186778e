// Of a captured facade: a corner, and which layers hold its triangle.
#include "graphics/render/frame.glsl"
#include "graphics/render/surface_outputs.glsl"
#include "capture/facades/facade_block.glsl"

layout(location = 0) in vec3 facade_corner;
layout(location = 1) in vec3 facade_normal;
layout(location = 2) in vec3 corner_fallback;
layout(location = 3) in uvec2 triangle_candidates;
layout(location = 4) in float surface_lit;  // logarithm of a luminance: encoded_luminance / 255
#ifdef IS_CHOSEN
layout(location = 5) in vec4 chosen_at;
layout(location = 6) in vec4 chosen_first;  // see facade_surface.glsl
layout(location = 7) in vec4 chosen_second;
layout(location = 8) in vec4 chosen_rest;
layout(location = 9) in ivec4 chosen_stored;
#endif

#ifdef RECEIVES_INSERTED
flat out float lit_luminance;
#endif
#ifdef IS_CHOSEN
out vec4 at_of_chosen, of_first, of_second;
out vec3 rest_of_chosen;
flat out ivec4 stored_of_chosen;
#else
out vec3 position_in_facade;
out vec3 fallback_colour;
flat out uvec2 candidates;  // the first, and how many
#endif

void surface_vertex() {
  position = (world_from_facade * vec4(facade_corner, 1.0f)).xyz;
  vertex_normal = (world_from_facade * vec4(facade_normal, 0.0f)).xyz;
  uv = vec2(0.0f);
  object_of_surface = facade_thing;
#ifdef IS_CHOSEN
  at_of_chosen = chosen_at;
  of_first = chosen_first, of_second = chosen_second, rest_of_chosen = chosen_rest.rgb;
  stored_of_chosen = chosen_stored;
#else
  position_in_facade = facade_corner;
  fallback_colour = corner_fallback;
  candidates = triangle_candidates;
#endif
#ifdef RECEIVES_INSERTED
  float bits = 255.0f * surface_lit;
  lit_luminance = bits < 0.5f ? 0.0f : exp2((bits - 1.0f) * (16.0f / 254.0f) - 10.0f);
#endif
}
