// Is a point in the sun? Looks a world position up in the sun's shadow maps: the static place from far, the static
// place near the viewer, and what moves. The host defines, before it includes this file,
//   float shadow_compare(int map, vec3 uvz)   1 where the map's depth at uv lies behind z, bilinear over four texels.
// Depth is orthographic, 0 at the sun's side and 1 at the far side.

const int shadow_far_map = 0;      // all static things, over the whole scene
const int shadow_near_map = 1;     // static things near the viewer, finer
const int shadow_moving_map = 2;   // moving things near the viewer
const int shadow_map_count = 3;

struct ShadowMaps {
  mat4 uvz_from_world[3];
  vec3 texel_m;  // size of a texel of each map on a plane that faces the sun
};

GLSL_FUNCTION bool is_inside_map(vec3 uvz, float margin) {
  return min(min(uvz.x, uvz.y), 1.0f - max(uvz.x, uvz.y)) > margin && uvz.z < 1.0f;
}

// Where to look: pushed off the surface along its normal by a texel or so, more at grazing light (Holbert 2011).
GLSL_FUNCTION vec3 shadow_coordinates(ShadowMaps maps, int map, vec3 position, vec3 geometric_normal, vec3 to_sun) {
  float texel = maps.texel_m[map];
  float slope = sqrt(clamp(1.0f - dot(geometric_normal, to_sun) * dot(geometric_normal, to_sun), 0.0f, 1.0f));
  vec3 lifted = position + (texel * (0.3f + 1.2f * slope)) * geometric_normal + (0.3f * texel) * to_sun;
  vec4 p = maps.uvz_from_world[map] * vec4(lifted, 1.0f);
  return vec3(p.x, p.y, p.z);
}

// 3x3 bilinear comparisons over 2 texels: an edge about as soft as the sun's penumbra under a cornice.
GLSL_FUNCTION float filtered_shadow(int map, vec3 uvz, float texel_uv) {
  float sum = 0.0f;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x)
      sum += shadow_compare(map, uvz + vec3(float(x) * texel_uv, float(y) * texel_uv, 0.0f));
  return sum / 9.0f;
}

// 1 in full sun, 0 in shadow. `texel_uv`: size of a texel of each map in texture coordinates.
GLSL_FUNCTION float sun_visibility(ShadowMaps maps, vec3 texel_uv, vec3 position, vec3 geometric_normal, vec3 to_sun) {
  vec3 near_uvz = shadow_coordinates(maps, shadow_near_map, position, geometric_normal, to_sun);
  vec3 far_uvz = shadow_coordinates(maps, shadow_far_map, position, geometric_normal, to_sun);
  float visibility = 1.0f;
  if (is_inside_map(near_uvz, 2.0f * texel_uv.y)) {
    visibility = filtered_shadow(shadow_near_map, near_uvz, texel_uv.y);
  } else if (is_inside_map(far_uvz, 2.0f * texel_uv.x)) {
    visibility = filtered_shadow(shadow_far_map, far_uvz, texel_uv.x);
  }
  vec3 moving_uvz = shadow_coordinates(maps, shadow_moving_map, position, geometric_normal, to_sun);
  if (visibility > 0.0f && is_inside_map(moving_uvz, 2.0f * texel_uv.z))
    visibility = min(visibility, filtered_shadow(shadow_moving_map, moving_uvz, texel_uv.z));
  return visibility;
}
