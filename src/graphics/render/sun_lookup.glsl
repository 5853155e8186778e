// The sun's shadow maps, at texture unit 5: a layer each.
#include "graphics/render/frame.glsl"
#include "graphics/shading/shadow.glsl"

uniform highp sampler2DArrayShadow shadow_maps;

float shadow_compare(int map, vec3 uvz) { return texture(shadow_maps, vec4(uvz.xy, float(map), uvz.z)); }

#include "graphics/shading/shadow_filter.glsl"

ShadowMaps frame_shadow_maps() {
  ShadowMaps maps;
  maps.uvz_from_world[0] = frame_uvz_from_world[0];
  maps.uvz_from_world[1] = frame_uvz_from_world[1];
  maps.texel_m = frame_shadow_texel.xy;
  maps.texel_uv = frame_shadow_texel.z;
  return maps;
}

float visible_sun(vec3 position, vec3 normal) {
  return sun_visibility(frame_shadow_maps(), position, normal, frame_to_sun.xyz);
}

// The same for the static scene alone, coarser.
float visible_fixed_sun(vec3 position, vec3 normal) {
  ShadowMaps maps = frame_shadow_maps();
  vec3 uvz = shadow_coordinates(maps, shadow_far_map, position, normal, frame_to_sun.xyz);
  return is_inside_map(uvz, 2.0f * maps.texel_uv) ? filtered_shadow(shadow_far_map, uvz, maps.texel_uv) : 1.0f;
}
