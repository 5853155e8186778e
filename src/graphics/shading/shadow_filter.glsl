// Is a point in the sun? Needs shading/shadow.glsl, and from the host
//   float shadow_compare(int map, vec3 uvz)   1 where the map's depth at uv lies behind z, bilinear

// A tent over 3x3 texels out of four bilinear comparisons (Castano 2013, Shadow Mapping Summary): an edge
// about as soft as the sun's penumbra under a cornice.
GLSL_FUNCTION float filtered_shadow(int map, vec3 uvz, float texel_uv) {
  vec2 texels = vec2(uvz.x, uvz.y) / texel_uv + vec2(0.5f);
  vec2 corner = floor(texels);
  vec2 share = texels - corner;
  vec2 low_weight = vec2(3.0f) - 2.0f * share;
  vec2 high_weight = vec2(1.0f) + 2.0f * share;
  vec2 low = (corner - vec2(1.5f) + (vec2(2.0f) - share) / low_weight) * texel_uv;
  vec2 high = (corner + vec2(0.5f) + share / high_weight) * texel_uv;
  return (low_weight.x * low_weight.y * shadow_compare(map, vec3(low.x, low.y, uvz.z)) +
          high_weight.x * low_weight.y * shadow_compare(map, vec3(high.x, low.y, uvz.z)) +
          low_weight.x * high_weight.y * shadow_compare(map, vec3(low.x, high.y, uvz.z)) +
          high_weight.x * high_weight.y * shadow_compare(map, vec3(high.x, high.y, uvz.z))) /
         16.0f;
}

// 1 in full sun, 0 in shadow. One lookup serves both maps: processors that draw run both sides of a branch.
GLSL_FUNCTION float sun_visibility(ShadowMaps maps, vec3 position, vec3 geometric_normal, vec3 to_sun) {
  vec3 near_uvz = near_shadow_coordinates(maps, position, geometric_normal, to_sun);
  vec3 far_uvz = shadow_coordinates(maps, shadow_far_map, position, geometric_normal, to_sun, maps.texel_m.x);
  bool is_near = is_inside_map(near_uvz, 2.0f * maps.texel_uv);
  bool is_known = is_near || is_inside_map(far_uvz, 2.0f * maps.texel_uv);
  float visibility = filtered_shadow(is_near ? shadow_near_map : shadow_far_map, is_near ? near_uvz : far_uvz,
                                     maps.texel_uv);
  return is_known ? visibility : 1.0f;
}
