// The sun's shadow maps, at texture unit 5: a layer each.
#include "render/frame.glsl"
#include "shading/shadow.glsl"

uniform highp sampler2DArrayShadow shadow_maps;

float shadow_compare(int map, vec3 uvz) { return texture(shadow_maps, vec4(uvz.xy, float(map), uvz.z)); }

#include "shading/shadow_filter.glsl"

float visible_sun(vec3 position, vec3 normal) {
  ShadowMaps maps;
  maps.uvz_from_world[0] = frame_uvz_from_world[0];
  maps.uvz_from_world[1] = frame_uvz_from_world[1];
  maps.texel_m = frame_shadow_texel.xy;
  maps.texel_uv = frame_shadow_texel.z;
  return sun_visibility(maps, position, normal, frame_to_sun.xyz);
}
