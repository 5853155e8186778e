// Wood of grown plants: tubes, or (IS_LINE) lines along their middles.
#include "life/vegetation/bark_layout.glsl"
#include "life/vegetation/plant_record.glsl"
#include "life/vegetation/leaf_surface.glsl"

layout(location = 0) in vec3 wood_position;
layout(location = 1) in vec4 wood_normal;  // of lines: along them; w: openness
layout(location = 2) in vec2 wood_uv;

#ifdef IS_LINE
uniform sampler2D bark_texture;  // of which the mean counts
#else
flat out vec3 bark_colour;
#endif

void surface_vertex() {
  position = in_world(wood_position);
  vec3 normal = normalize(turned_to_world(wood_normal.xyz));
#ifdef IS_LINE
  vec3 to_viewer = normalize(viewer_position.xyz - position);
  normal = normalize(to_viewer - normal * dot(normal, to_viewer) + 1e-4f * to_viewer);
#endif
  vertex_normal = normal;
  uv = bark_repeats * wood_uv;
  object_of_surface = int(plant_thing);
#ifdef IS_LINE
  leaf_sun = sun_by_one_texel(normal);
  light_speck(bark_surface(normal, textureLod(bark_texture, uv, 8.0f).rgb, dark_colour.rgb),
              sky_visibility_cell(position, normal), wood_normal.w);
#else
  leaf_sun = visible_sun(position, normal);
  vec4 sky_cell = shaded_cell(sky_visibility_cell(position, normal),
                              sky_share_beside_bodies(position, normal, int(plant_thing)));
  light_corner(normal, sky_cell, wood_normal.w, bark_roughness, 0.0f);
  bark_colour = dark_colour.rgb;
#endif
}
