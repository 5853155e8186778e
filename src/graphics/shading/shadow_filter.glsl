// Is a point in the sun? Needs shading/shadow.glsl, and from the host
//   float shadow_compare(int map, vec3 uvz)   1 where the map's depth at uv lies behind z, bilinear

// In texels, against the roundings of maps and the difference between a surface and its interpolated normals,
// and between the levels of detail in which a thing is seen and casts its shadow.
const float shadow_lift = 0.2f, shadow_bias = 0.3f;
const float min_shadow_facing = 0.02f;  // cosine: planes are taken to be no steeper to the sun
// A plane that the sun grazes runs metres deep within a texel, and at the foot of a wall below the ground,
// which would darken it: away from the sun no texel of a filter is compared with more than this beyond the
// receiver.
const float max_shadow_depth = 2.0f;

// What a map is asked about a receiver: its place in texture coordinates, and how its depth changes along the
// plane of its surface, so that each texel of a filter is compared with the plane's own depth there
// (receiver-plane depth bias: Isidoro 2006). Lookups need not leave the surface by a whole filter's width
// then, which would shift every edge of a shadow by as much.
struct ShadowReceiver {
  vec3 uvz;
  vec2 slope;        // change of depth per unit of u and of v
  float bias;        // of depth, toward the sun
  float max_beyond;  // of depth: max_shadow_depth
};

// The same of a surface with unit `normal`. `tile` is scale and offset of the tile of the map that is asked;
// `texel_m` the size of its texels there.
GLSL_FUNCTION ShadowReceiver shadow_receiver(ShadowMaps maps, int map, vec4 tile, vec3 position, vec3 normal,
                                             vec3 to_sun, float texel_m) {
  mat4 m = maps.uvz_from_world[map];
  vec3 lifted = position + (shadow_lift * texel_m) * normal;
  vec4 p = m * vec4(lifted, 1.0f);
  float per_w = 1.0f / max(p.w, 1e-4f);
  vec3 uvz = vec3(p.x, p.y, p.z) * per_w;
  vec3 of_w = vec3(m[0][3], m[1][3], m[2][3]);
  vec3 du = per_w * (vec3(m[0][0], m[1][0], m[2][0]) - uvz.x * of_w);
  vec3 dv = per_w * (vec3(m[0][1], m[1][1], m[2][1]) - uvz.y * of_w);
  vec3 dz = per_w * (vec3(m[0][2], m[1][2], m[2][2]) - uvz.z * of_w);
  // The normal of the plane in texture coordinates: by the cofactors of the rows du, dv, dz.
  vec3 across = cross(du, dv);  // along the sun
  float facing = dot(normal, across), min_facing = min_shadow_facing * length(across);
  facing = facing < 0.0f ? min(facing, -min_facing) : max(facing, min_facing);
  ShadowReceiver receiver;
  receiver.uvz = p.w > 1e-4f ? vec3(uvz.x * tile.x + tile.z, uvz.y * tile.y + tile.w, uvz.z) : vec3(-1.0f);
  receiver.slope = -vec2(dot(normal, cross(dv, dz)) / tile.x, dot(normal, cross(dz, du)) / tile.y) / facing;
  // Within half a texel of the middle of four texels: what a bilinear comparison reads.
  receiver.bias = 0.5f * maps.texel_uv * (abs(receiver.slope.x) + abs(receiver.slope.y)) +
                  shadow_bias * texel_m * abs(dot(dz, to_sun));
  receiver.max_beyond = max_shadow_depth * texel_m * abs(dot(dz, to_sun));
  return receiver;
}

// A tent over 3x3 texels out of four bilinear comparisons (Castano 2013, Shadow Mapping Summary): an edge
// about as soft as the sun's penumbra under a cornice. Each compares the depth of the receiver's plane in the
// middle of its four texels.
GLSL_FUNCTION float filtered_shadow(int map, ShadowReceiver receiver, float texel_uv) {
  vec2 texels = vec2(receiver.uvz.x, receiver.uvz.y) / texel_uv + vec2(0.5f);
  vec2 corner = floor(texels);
  vec2 share = texels - corner;
  vec2 low_weight = vec2(3.0f) - 2.0f * share;
  vec2 high_weight = vec2(1.0f) + 2.0f * share;
  vec2 low = (corner - vec2(1.5f) + (vec2(2.0f) - share) / low_weight) * texel_uv;
  vec2 high = (corner + vec2(0.5f) + share / high_weight) * texel_uv;
  vec2 low_depth = receiver.slope * (vec2(-0.5f) - share) * texel_uv;
  vec2 high_depth = receiver.slope * (vec2(1.5f) - share) * texel_uv;
  // Of the corners (low, low), (high, low), (low, high), (high, high).
  vec4 beyond = vec4(low_depth.x + low_depth.y, high_depth.x + low_depth.y, low_depth.x + high_depth.y,
                     high_depth.x + high_depth.y);
  vec4 z = vec4(receiver.uvz.z - receiver.bias) + min(beyond, vec4(receiver.max_beyond));
  return (low_weight.x * low_weight.y * shadow_compare(map, vec3(low.x, low.y, z.x)) +
          high_weight.x * low_weight.y * shadow_compare(map, vec3(high.x, low.y, z.y)) +
          low_weight.x * high_weight.y * shadow_compare(map, vec3(low.x, high.y, z.z)) +
          high_weight.x * high_weight.y * shadow_compare(map, vec3(high.x, high.y, z.w))) /
         16.0f;
}

// 1 in full sun, 0 in shadow. One lookup serves both maps: processors that draw run both sides of a branch.
GLSL_FUNCTION float sun_visibility(ShadowMaps maps, vec3 position, vec3 geometric_normal, vec3 to_sun) {
  vec4 at_near = maps.uvz_from_world[shadow_near_map] * vec4(position, 1.0f);
  vec4 whole = vec4(1.0f, 1.0f, 0.0f, 0.0f);
  vec4 tile = maps.tile_count > 0 ? shadow_tile(maps, vec2(at_near.x, at_near.y)) : whole;
  vec3 near_uvz = at_near.w > 1e-4f ? vec3(at_near.x, at_near.y, at_near.z) / at_near.w : vec3(-1.0f);
  bool is_near = tile.x > 0.0f && is_inside_map(near_uvz, 3.0f * maps.texel_uv);
  int map = is_near ? shadow_near_map : shadow_far_map;
  tile = is_near ? tile : whole;
  float texel_m = shadow_texel(maps, map, position) / min(tile.x, tile.y);
  ShadowReceiver receiver = shadow_receiver(maps, map, tile, position, geometric_normal, to_sun, texel_m);
  bool is_known = is_near || is_inside_map(receiver.uvz, 2.0f * maps.texel_uv);
  float visibility = filtered_shadow(map, receiver, maps.texel_uv);
  return is_known ? visibility : 1.0f;
}
