// The sun's shadow maps, at texture unit 5: a layer each.
#include "graphics/render/frame.glsl"
#include "graphics/shading/shadow.glsl"

// RECEIVES_INSERTED: surfaces show photographs, which hold their own shadows. They have maps of what their
// photographs do not show.
#ifdef RECEIVES_INSERTED
uniform highp sampler2DArrayShadow inserted_shadow_maps;
#define shadow_maps inserted_shadow_maps
#else
uniform highp sampler2DArrayShadow shadow_maps;
#endif

float shadow_compare(int map, vec3 uvz) { return texture(shadow_maps, vec4(uvz.xy, float(map), uvz.z)); }

#include "graphics/shading/shadow_filter.glsl"

ShadowMaps frame_shadow_maps() {
  ShadowMaps maps;
#ifdef RECEIVES_INSERTED
  maps.uvz_from_world[0] = frame_inserted_uvz_from_world[0];
  maps.uvz_from_world[1] = frame_inserted_uvz_from_world[1];
  maps.texel_m = frame_inserted_texel.xy;
  maps.texel_uv = frame_inserted_texel.z;
  maps.growth = 0.0f;
  maps.tile_count = 0;
  return maps;
#else
  maps.uvz_from_world[0] = frame_uvz_from_world[0];
  maps.uvz_from_world[1] = frame_uvz_from_world[1];
  maps.texel_m = frame_shadow_texel.xy;
  maps.texel_uv = frame_shadow_texel.z;
  maps.growth = frame_shadow_texel.w;
  maps.tile_count = int(frame_shadow_extra.x);
  for (int i = 0; i < max_shadow_tiles; ++i) maps.tiles[i] = frame_shadow_tiles[i];
  return maps;
#endif
}

// Unit; of a spot light in the sun's place it differs from point to point.
vec3 to_sun_at(vec3 position) {
  return frame_spot.w > -1.5f ? normalize(frame_spot.xyz - position) : frame_to_sun.xyz;
}

// 1 but outside a spot light's cone.
float sun_cone(vec3 to_light) {
  return frame_spot.w > -1.5f ? spot_share(dot(to_light, frame_to_sun.xyz), frame_spot.w) : 1.0f;
}

float visible_sun(vec3 position, vec3 normal) {
  vec3 to_light = to_sun_at(position);
  return sun_visibility(frame_shadow_maps(), position, normal, to_light) * sun_cone(to_light);
}

// The same for the static scene alone, coarser.
float visible_fixed_sun(vec3 position, vec3 normal) {
  ShadowMaps maps = frame_shadow_maps();
  ShadowReceiver receiver = shadow_receiver(maps, shadow_far_map, vec4(1.0f, 1.0f, 0.0f, 0.0f), position,
                                            normal, frame_to_sun.xyz, maps.texel_m.x);
  return is_inside_map(receiver.uvz, 2.0f * maps.texel_uv)
             ? filtered_shadow(shadow_far_map, receiver, maps.texel_uv)
             : 1.0f;
}
