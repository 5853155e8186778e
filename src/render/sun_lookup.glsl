// The sun's shadow maps, at texture units 5 to 7.
#include "render/frame.glsl"
#include "shading/shadow.glsl"

uniform highp sampler2DShadow far_shadow_map;
uniform highp sampler2DShadow near_shadow_map;
uniform highp sampler2DShadow moving_shadow_map;

float shadow_compare(int map, vec3 uvz) {
  if (map == 0) return texture(far_shadow_map, uvz);
  if (map == 1) return texture(near_shadow_map, uvz);
  return texture(moving_shadow_map, uvz);
}


#include "shading/shadow_filter.glsl"

float visible_sun(vec3 position, vec3 normal) {
  ShadowMaps maps;
  for (int i = 0; i < 3; ++i) maps.uvz_from_world[i] = frame_uvz_from_world[i];
  maps.texel_m = frame_texel_m.xyz;
  return sun_visibility(maps, frame_texel_uv.xyz, position, normal, frame_to_sun.xyz);
}
