// Reflections out of reference maps (Meyer and Loscos 2003, sections 4.1 to 4.3), for each pixel: the mirror ray is traced
// through the city's heights from the surface itself, and the point that it meets is looked up in the maps about it that
// see it.
#include "render/sky_lookup.glsl"
#include "environment_maps/octahedral.glsl"
#include "render/surface_body.glsl"

uniform highp sampler2D heights;
uniform highp sampler2DArray map_colours;
uniform highp sampler2DArray map_distances;
uniform highp usampler2D map_choice;  // four maps a cell of the ground
uniform highp sampler2D map_places;
uniform vec4 height_grid;   // south-west corner, metres a cell, top level
uniform vec2 height_cells;
uniform vec3 choice_grid;   // south-west corner, metres a cell
uniform vec2 layer_size;    // texels a side, and of its border

const float reach_m = 1000.0f;
const float texel_rad = 3.545f;  // the sphere's area over that of the square: a layer of one texel spans so much

float cell_height(ivec2 cell, int level) { return texelFetch(heights, cell, level).r; }

#include "environment_maps/heightfield_walk.glsl"
#include "environment_maps/validity.glsl"

vec3 reflected_radiance(vec3 at, vec3 direction, float roughness) {
  HeightGrid grid = HeightGrid(height_grid.xy, height_grid.z, ivec2(height_cells), int(height_grid.w));
  HeightHit hit = walk_pyramid(grid, at, direction, reach_m);
  vec3 met = at + hit.distance * direction;

  // The pixel's own cone: what it sees spreads with the distance.
  float spread = max(length(dFdx(direction)), length(dFdy(direction)));
  ivec2 cells = textureSize(map_choice, 0);
  ivec2 cell = clamp(ivec2((at.xy - choice_grid.xy) / choice_grid.z), ivec2(0), cells - ivec2(1));
  uvec4 maps = texelFetch(map_choice, cell, 0);

  vec3 sum = vec3(0.0f), nearest = vec3(0.0f);
  float weights = 0.0f, highest = 0.0f;
  for (int k = 0; k < 4; ++k) {
    int map = int(maps[k]);
    vec3 place = texelFetch(map_places, ivec2(map, 0), 0).xyz;
    vec3 to_met = met - place;
    float distance_m = length(to_met);
    vec3 uv = vec3(layer_uv(to_met / distance_m, layer_size.x, layer_size.y), float(map));
    float seen_m = textureLod(map_distances, uv, 0.0f).r;
    float texels = spread * hit.distance / distance_m * layer_size.x / texel_rad;
    vec3 colour = textureLod(map_colours, uv, log2(max(texels, 1.0f)) + 4.0f * roughness).rgb;

    vec3 away = place - at;
    float closeness = 1.0f / (1.0f + dot(away, away));
    float weight = closeness * validity(seen_m, distance_m, height_grid.z);
    sum += weight * colour;
    weights += weight;
    if (closeness > highest) {
      highest = closeness;
      nearest = colour;
    }
  }
  // Section 4.3: where no map sees the point, the one that would count most.
  return weights > 1e-3f * highest ? sum / weights : nearest;
}
