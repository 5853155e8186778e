// What one draw command says of its plant: attributes of an instance (plant_drawable.cpp).
#include "graphics/render/frame.glsl"
#include "graphics/render/body_lookup.glsl"
#include "graphics/render/sun_lookup.glsl"
#include "graphics/render/surface_outputs.glsl"
#include "graphics/render/leaf_light.glsl"

layout(location = 4) in vec4 world_from_plant_row0;
layout(location = 5) in vec4 world_from_plant_row1;
layout(location = 6) in vec4 world_from_plant_row2;
layout(location = 7) in vec4 shown_leaves;  // share shown, share over which the last fade, growth of lengths,
                                            // scale of the plant
layout(location = 8) in vec4 dark_colour;   // of leaves, or bark; w: veins per leaf length
layout(location = 9) in vec4 light_colour;  // w: translucency and, behind the point, roughness
layout(location = 10) in uint plant_thing;

vec3 in_world(vec3 p) {
  vec4 at = vec4(p, 1.0f);
  return vec3(dot(world_from_plant_row0, at), dot(world_from_plant_row1, at), dot(world_from_plant_row2, at));
}

vec3 turned_to_world(vec3 v) {
  return vec3(dot(world_from_plant_row0.xyz, v), dot(world_from_plant_row1.xyz, v),
              dot(world_from_plant_row2.xyz, v));
}

// Size of a leaf of this rank (0..1, its place in prefix order), as a factor to its length.
float grown_length(float rank) {
  float weight = shown_leaves.y > 0.0f ? clamp((shown_leaves.x - rank) / shown_leaves.y, 0.0f, 1.0f) : 1.0f;
  return shown_leaves.z * sqrt(weight);
}

// Share of the sun that is seen from the vertex, `normal` unit and on the viewer's side, for leaves and
// lines, of which there are many: one comparison with the shadow map.
float sun_by_one_texel(vec3 normal) {
  ShadowMaps maps = frame_shadow_maps();
  vec3 to_light = to_sun_at(position);
  vec3 near_uvz = near_shadow_coordinates(maps, position, normal, to_light);
  vec3 far_uvz = shadow_coordinates(maps, shadow_far_map, position, normal, to_light, maps.texel_m.x);
  bool is_near = is_inside_map(near_uvz, maps.texel_uv);
  bool is_known = is_near || is_inside_map(far_uvz, maps.texel_uv);
  float lit = shadow_compare(is_near ? shadow_near_map : shadow_far_map, is_near ? near_uvz : far_uvz);
  return (is_known ? lit : 1.0f) * sun_cone(to_light);
}
