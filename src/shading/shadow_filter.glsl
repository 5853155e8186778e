// Is a point in the sun? Needs shading/shadow.glsl, and from the host
//   float shadow_compare(int map, vec3 uvz)   1 where the map's depth at uv lies behind z, bilinear over four texels.

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
