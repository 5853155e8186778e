// Mirror-like surfaces that look their surroundings up in a cube map, as if it were infinitely far or the inside of a box.
#include "render/sky_lookup.glsl"
#include "probes/box_projection.glsl"
#include "render/surface_body.glsl"

uniform samplerCube reflection_map;
uniform float reflection_levels;
uniform float box_is_used;
uniform vec3 map_centre;
uniform vec3 box_centre;
uniform vec3 box_half_size;
uniform vec2 box_heading;  // cosine and sine

const float most_taps = 4.0f;  // each way

vec3 looked_up_direction;

void look_along(vec3 at, vec3 direction) {
  looked_up_direction = direction;
  if (box_is_used > 0.5f)
    looked_up_direction = box_projected_direction(at, direction, map_centre, box_centre, box_half_size, box_heading);
}

// Curved mirrors squeeze wide angles into a pixel, and toward the rim in one direction only: lookups spread over the
// pixel's footprint, each as wide as its share, keep what one as wide as the footprint would blur. Half a level less
// keeps edges as sharp as many rays a pixel show them.
vec3 reflected_radiance(float roughness, int layer) {
  vec3 d = looked_up_direction;
  vec3 along_x = dFdx(d), along_y = dFdy(d);
  float texels_a_unit = 0.5f * exp2(reflection_levels) / max(abs(d.x), max(abs(d.y), abs(d.z)));
  float size_x = texels_a_unit * length(along_x), size_y = texels_a_unit * length(along_y);
  float taps_x = clamp(ceil(size_x), 1.0f, most_taps), taps_y = clamp(ceil(size_y), 1.0f, most_taps);
  float level = log2(max(max(size_x / taps_x, size_y / taps_y), 1e-4f)) - 0.5f + roughness * reflection_levels * 0.8f;
  vec3 sum = vec3(0.0f);
  for (float y = 0.5f; y < taps_y; ++y)
    for (float x = 0.5f; x < taps_x; ++x)
      sum += textureLod(reflection_map, d + (x / taps_x - 0.5f) * along_x + (y / taps_y - 0.5f) * along_y, level).rgb;
  return sum / (taps_x * taps_y);
}
