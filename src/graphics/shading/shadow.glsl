// Where a point of the world lies in the sun's two shadow maps: the whole place, coarse, and what is near the
// viewer, fine. They have the same size. Depth grows from 0 at the sun's side to 1 at the far side. The far
// map is orthographic; the near one may be a projection that a view asks for (perspective shadow maps), or
// hold up to four tiles of different scales (cascades).

const int shadow_far_map = 0;   // all that stands still, over the whole scene
const int shadow_near_map = 1;  // what stands or moves near the viewer
const int shadow_map_count = 2;
const int max_shadow_tiles = 4;

struct ShadowMaps {
  mat4 uvz_from_world[2];
  vec2 texel_m;    // size of a texel of each map on a plane that faces the sun; in a projection, at w = 1
  float texel_uv;  // and in texture coordinates
  float growth;    // of the near map's texel along its longer side: texel_m * w * max(1, growth * w); 0: not
                   // projected
  int tile_count;  // of the near map; 0: it is one
  vec4 tiles[4];   // scale and offset from its uv to those of each quarter, from coarse to fine
};

// How much of a spot light arrives, by the cosine of the angle to its axis and that of its cone: its edge is
// soft within a twentieth of the cone.
GLSL_FUNCTION float spot_share(float cosine, float cone_cosine) {
  return smoothstep(cone_cosine, cone_cosine + 0.05f * (1.0f - cone_cosine), cosine);
}

GLSL_FUNCTION bool is_inside_map(vec3 uvz, float margin) {
  return min(min(uvz.x, uvz.y), 1.0f - max(uvz.x, uvz.y)) > margin && uvz.z < 1.0f;
}

// Size of a texel of a map about a point.
GLSL_FUNCTION float shadow_texel(ShadowMaps maps, int map, vec3 position) {
  if (map == shadow_far_map || maps.growth <= 0.0f) return maps.texel_m[map];
  mat4 m = maps.uvz_from_world[shadow_near_map];
  float w = max(m[0][3] * position.x + m[1][3] * position.y + m[2][3] * position.z + m[3][3], 1e-4f);
  return maps.texel_m[map] * w * max(1.0f, maps.growth * w);
}

// Where to look: pushed off the surface along its normal by a texel or so, more at grazing light (Holbert
// 2011).
GLSL_FUNCTION vec3 shadow_coordinates(ShadowMaps maps, int map, vec3 position, vec3 geometric_normal,
                                      vec3 to_sun, float texel) {
  float slope = sqrt(clamp(1.0f - dot(geometric_normal, to_sun) * dot(geometric_normal, to_sun), 0.0f, 1.0f));
  vec3 lifted = position + (texel * (0.3f + 1.2f * slope)) * geometric_normal + (0.3f * texel) * to_sun;
  vec4 p = maps.uvz_from_world[map] * vec4(lifted, 1.0f);
  // Behind a projection's centre there is no map.
  return p.w > 1e-4f ? vec3(p.x, p.y, p.z) / p.w : vec3(-1.0f);
}

// The finest tile of the near map that holds a point of its uv; of no scale where none does.
GLSL_FUNCTION vec4 shadow_tile(ShadowMaps maps, vec2 uv) {
  vec4 tile = vec4(0.0f);
  for (int i = 0; i < maps.tile_count; ++i) {
    vec2 at = uv * vec2(maps.tiles[i].x, maps.tiles[i].y) + vec2(maps.tiles[i].z, maps.tiles[i].w);
    int column = i % 2, row = i / 2;
    vec2 inside = at - 0.5f * vec2(float(column), float(row));
    bool holds = min(min(inside.x, inside.y), 0.5f - max(inside.x, inside.y)) > 4.0f * maps.texel_uv;
    tile = holds ? maps.tiles[i] : tile;
  }
  return tile;
}

// The same for the near map: outside of it where uv are negative.
GLSL_FUNCTION vec3 near_shadow_coordinates(ShadowMaps maps, vec3 position, vec3 geometric_normal,
                                           vec3 to_sun) {
  float texel = shadow_texel(maps, shadow_near_map, position);
  if (maps.tile_count == 0)
    return shadow_coordinates(maps, shadow_near_map, position, geometric_normal, to_sun, texel);
  vec4 p = maps.uvz_from_world[shadow_near_map] * vec4(position, 1.0f);
  vec4 tile = shadow_tile(maps, vec2(p.x, p.y));
  if (tile.x <= 0.0f) return vec3(-1.0f);
  vec3 uvz = shadow_coordinates(maps, shadow_near_map, position, geometric_normal, to_sun,
                                texel / min(tile.x, tile.y));
  return vec3(uvz.x * tile.x + tile.z, uvz.y * tile.y + tile.w, uvz.z);
}
