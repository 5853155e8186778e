// Where a point of the world lies in the sun's two shadow maps: the whole place, coarse, and what is near the viewer,
// fine. They have the same size. Depth is orthographic, 0 at the sun's side and 1 at the far side.

const int shadow_far_map = 0;   // all that stands still, over the whole scene
const int shadow_near_map = 1;  // what stands or moves near the viewer
const int shadow_map_count = 2;

struct ShadowMaps {
  mat4 uvz_from_world[2];
  vec2 texel_m;    // size of a texel of each map on a plane that faces the sun
  float texel_uv;  // and in texture coordinates
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
