// Wood of grown plants: tubes, or (IS_LINE) lines along their middles.
#define IS_LEAF  // light is evaluated at the corners alone: surface_outputs.glsl
#include "life/vegetation/bark_layout.glsl"
#include "life/vegetation/plant_record.glsl"

layout(location = 0) in vec3 wood_position;
layout(location = 1) in vec4 wood_normal;  // of lines: along them; w: openness
layout(location = 2) in vec2 wood_uv;

flat out vec3 bark_colour;
out float wood_openness;

void surface_vertex() {
  position = in_world(wood_position);
  vec3 normal = normalize(turned_to_world(wood_normal.xyz));
#ifdef IS_LINE
  vec3 to_viewer = normalize(viewer_position.xyz - position);
  normal = normalize(to_viewer - normal * dot(normal, to_viewer) + 1e-4f * to_viewer);
#endif
  vertex_normal = normal;
  uv = bark_repeats * wood_uv;
  wood_openness = wood_normal.w;
  bark_colour = dark_colour.rgb;
#ifdef IS_LINE
  light_small_vertex(normal);
#else
  light_vertex(normal);
#endif
  object_of_surface = int(plant_thing);
}
