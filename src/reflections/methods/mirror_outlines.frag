// Drawn at the far plane over pixels that have a first mirror ray: those about which first rays are alike
// keep the depth of their surface, so that second rays are sought of nearer surfaces alone; at all others,
// which several surfaces may share, of any.
#include "graphics/shading/octahedral.glsl"
#include "reflections/methods/ray_difference.glsl"

void main() {
  ivec3 here = ivec3(ivec2(gl_FragCoord.xy), 0);
  vec3 start = texelFetch(ray_starts, here, 0).xyz;
  vec4 ray = texelFetch(ray_directions, here, 0);
  vec3 direction = octahedral_direction(ray.xy);
  vec2 footprint_m = vec2(1e9f);  // the nearer of both neighbours in each direction
  for (int i = 0; i < 4; ++i) {
    float away_m = length(texelFetch(ray_starts, ivec3(pixel_beside(i), 0), 0).xyz - start);
    footprint_m[i / 2] = min(footprint_m[i / 2], max(away_m, 1e-4f));
  }
  float most = 0.0f;
  for (int i = 0; i < 4; ++i)
    most = max(most, ray_difference(ivec3(pixel_beside(i), 0), int(ray.w), start, direction,
                                    footprint_m.x + footprint_m.y));
  if (most <= 1.0f) discard;
}
