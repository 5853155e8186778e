// Reflections from reference maps (Meyer and Loscos 2003, sections 4.1 to 4.3), per pixel. The mirror ray is traced from the
// surface through the city's height field; the hit is moved onto the surface that the maps have recorded, and looked up in the
// two maps that show it best:
//   radiance = shade * sum_k w_k map_k(hit - place_k, footprint),   w_k ~ validity_k / (0.5 + d_k^2 + 0.2 a_k^2)
// d_k: distance of map k from the ray, a_k: along the ray, metres.
#include "graphics/render/frame.glsl"
#include "graphics/render/body_lookup.glsl"
#include "graphics/render/sky_lookup.glsl"
#include "graphics/render/sun_lookup.glsl"
#include "graphics/shading/octahedral.glsl"
#include "graphics/shading/surface.glsl"
#include "graphics/shading/lighting.glsl"
#include "reflections/reference_maps/map_levels.glsl"

layout(location = 0) out vec4 base_radiance;  // alpha 1: the pixel reflects
layout(location = 1) out vec3 coat_radiance;

uniform highp sampler2D ray_starts;  // xyz; w: roughness of the base
uniform highp sampler2D ray_ways;    // octahedral; z: roughness of the coat, w: the object and 1
uniform int reflecting_object;

uniform highp sampler2D heights;
uniform highp sampler2DArray map_colours;
uniform highp sampler2DArray map_glosses;
uniform highp sampler2DArray map_distances;
uniform highp usampler2D map_choice;  // four maps per ground cell
uniform highp sampler2D map_places;
uniform vec4 height_grid;   // south-west corner, metres per cell, top level
uniform vec2 height_cells;
uniform vec3 choice_grid;   // south-west corner, metres per cell
uniform vec2 layer_size;    // texels per side, and of its border

const float reach_m = 1000.0f;
const float max_move_m = 2.5f;  // of a hit onto the recorded surface: heights have the resolution of a cell
const float max_taps = 4.0f;
const float first_step_m = 2.0f;     // when marching through a map's depth
const float step_growth = 1.4f;      // to 30 m
const int max_steps = 9;
const float max_crossing_m = 2.0f;  // depth difference of a hit: at silhouettes the recorded depth jumps by more
const int max_cells_under = 8;      // maximum number of cells that a ray passes under a bridge or an arch
#ifndef DETAIL
#define DETAIL 2
#endif
const int detail = DETAIL;           // MultipleEnvironmentMaps::Detail
const int one_map = 1;
const int all_detail = 2;
const int max_maps = detail == all_detail ? 2 : 1;
const float max_radiance = 30000.0f;  // the target holds half floats
const float min_wide_lobe = 0.3f;  // roughness
const float share_over_ground = 0.4f;
const float min_weight = 0.05f;    // a second map with less is skipped
const float shade_reach_m = 25.0f;   // ground up to this distance is shaded by dynamic objects
const float max_ground_error_m = 0.2f;  // a cell has one height: beside a kerb a hit may lie inside the pavement

float cell_height(ivec2 cell, int level) { return texelFetch(heights, cell, level).r; }

#include "reflections/reference_maps/heightfield_walk.glsl"
#include "reflections/reference_maps/validity.glsl"
#include "reflections/environment_rays/mirrored_bodies.glsl"

// The hit of the pixel's ray, as two maps show it.
struct Sight {
  vec3 to_met[2];    // from each map
  float map[2];
  float weight[2];
  float distance;
  vec3 across;       // major axis of the pixel's footprint at the hit, metres
  float narrow;      // length of its minor axis, metres
  vec3 direction;    // of the mirror ray
  bool is_ground;    // the ray hits the top of a cell
  vec3 shade;        // fraction of its light that dynamic objects leave
  bool is_body;      // the ray hits a dynamic object, which no map shows
  vec3 body_radiance;
};
Sight sight;

float seen_distance(vec3 to_point, float map) {
  return textureLod(map_distances, vec3(layer_uv(to_point, layer_size.x, layer_size.y), map), 0.0f).r;
}

// Minimum distance over the bilinear footprint. Filtering distances across a silhouette invents surfaces between foreground and
// background; colour lookups suffer the same.
float min_seen_distance(vec3 to_point, float map) {
  vec2 texel = layer_uv(to_point, layer_size.x, layer_size.y) * layer_size.x - 0.5f;
  ivec3 low = ivec3(ivec2(clamp(texel, vec2(0.0f), layer_size.xx - 2.0f)), int(map));
  vec2 south = vec2(texelFetch(map_distances, low, 0).r, texelFetch(map_distances, low + ivec3(1, 0, 0), 0).r);
  vec2 north = vec2(texelFetch(map_distances, low + ivec3(0, 1, 0), 0).r, texelFetch(map_distances, low + ivec3(1, 1, 0), 0).r);
  vec2 least = min(south, north);
  return min(least.x, least.y);
}

// Intersection of the ray with the surface that a map has recorded: two steps of the secant method from the hit on the height
// field (distance impostors, Szirmay-Kalos and others 2005).
float hit_on_map(vec3 at, vec3 direction, float distance, vec3 place, float map) {
  float near = distance;
  vec3 to_near = at + near * direction - place;
  float near_off = length(to_near) - seen_distance(normalize(to_near), map);
  if (abs(near_off) > max_move_m) return distance;
  float along = dot(direction, normalize(to_near));
  float far = distance - near_off * sign(along) / max(abs(along), 0.4f);
  for (int i = 0; i < 2; ++i) {
    vec3 to_far = at + far * direction - place;
    float far_off = length(to_far) - seen_distance(normalize(to_far), map);
    float change = far_off - near_off;
    if (abs(change) < 1e-4f) break;
    float next = far - far_off * (far - near) / change;
    near = far;
    near_off = far_off;
    far = clamp(next, distance - max_move_m, distance + max_move_m);
  }
  return max(far, 0.0f);
}

// Visibility of the sun without dynamic objects. Beside a wall the shadow map leaks light by a texel or two; a second lookup, a
// step toward the sun, is inside the wall.
float visible_sun_without_bodies(vec3 met, vec3 normal) {
  vec2 step_m = 2.0f * frame_shadow_texel.x * frame_to_sun.xy / max(length(frame_to_sun.xy), 1e-4f);
  return min(visible_fixed_sun(met, normal), visible_fixed_sun(met + vec3(step_m, 0.0f), normal));
}

// Ratio of the ground's irradiance with and without dynamic objects: no map shows the shadows of cars. Walls are left out, because
// the height field is too coarse for them.
vec3 share_left_by_bodies(vec3 met) {
  const vec3 normal = vec3(0.0f, 0.0f, 1.0f);
  vec3 sh[9];
  for (int i = 0; i < 9; ++i) sh[i] = frame_sky_sh[i].rgb;
  vec3 sky = sky_share_of_normal(sky_visibility_cell(met, normal), normal) * sky_irradiance(sh, normal);
  vec3 sun = max(dot(normal, frame_to_sun.xyz), 0.0f) * frame_sun_irradiance.rgb;
  float fixed_sun = visible_sun_without_bodies(met, normal);
  vec3 above_ground = met + max_ground_error_m / max(frame_to_sun.z, 0.2f) * frame_to_sun.xyz;
  float sun_share = min(visible_sun(above_ground, normal), fixed_sun);
  float sky_share = sky_share_beside_bodies(met, normal, -1);
  return (sky_share * sky + sun_share * sun) / max(sky + fixed_sun * sun, vec3(1e-4f));
}

// Radiance of a dynamic object: diffuse colour below a clear coat, which reflects the map nearest to it.
vec3 radiance_of_body(BodyHit body, vec3 met, vec3 direction, float map) {
  vec3 sh[9];
  for (int i = 0; i < 9; ++i) sh[i] = frame_sky_sh[i].rgb;
  vec3 sky = sky_share_of_normal(sky_visibility_cell(met, body.normal), body.normal) * sky_irradiance(sh, body.normal);
  float facing_sun = max(dot(body.normal, frame_to_sun.xyz), 0.0f);
  vec3 light = sky + facing_sun * visible_sun(met, body.normal) * frame_sun_irradiance.rgb;
  vec2 uv = layer_uv(reflect(direction, body.normal), gloss_side, gloss_border);
  vec3 mirrored = textureLod(map_glosses, vec3(gloss_uv(uv, 0.0f), map), 0.0f).rgb;
  float mirrors = 0.04f + 0.96f * schlick_weight(-dot(direction, body.normal));
  return (1.0f - mirrors) / pi * body.base_colour * light + mirrors * mirrored;
}

uvec4 maps_about(vec3 at) {
  ivec2 cells = textureSize(map_choice, 0);
  ivec2 cell = clamp(ivec2((at.xy - choice_grid.xy) / choice_grid.z), ivec2(0), cells - ivec2(1));
  return texelFetch(map_choice, cell, 0);
}

// Position of a map; w: its layer.
vec4 place_of(uint map) { return vec4(texelFetch(map_places, ivec2(int(map), 0), 0).xyz, float(map)); }

// For reflectors that are small in the image: the hit is assumed at the distance that the nearest map has recorded in the ray's
// direction.
void look_into_nearest_map(vec3 at, vec3 direction) {
  vec4 place = place_of(maps_about(at).x);
  sight.distance = seen_distance(direction, place.w);
  sight.to_met[0] = at + sight.distance * direction - place.xyz;
  sight.map[0] = place.w;
  sight.weight[0] = 1.0f;
}

// The two of the four maps around the reflecting point that show the hit best.
void choose_maps(vec3 at, vec3 direction, vec3 met, out vec4 places[2], out float weights[2]) {
  uvec4 maps = maps_about(at);
  weights = float[2](-1.0f, -1.0f);
  for (int k = 0; k < 4; ++k) {
    vec4 place = place_of(maps[k]);
    vec3 to_met = met - place.xyz;
    float distance_m = length(to_met);
    float valid = validity(min_seen_distance(to_met / distance_m, place.w), distance_m, height_grid.z);
    // The closer a map is to the ray, the less an error in the hit's distance displaces the lookup.
    vec3 away = place.xyz - at;
    float along = dot(away, direction);
    float off_ray = dot(away, away) - along * along;
    // Section 4.3: where no map sees the hit, the one with the largest weight otherwise.
    float weight = (valid + 1e-4f) / (0.5f + off_ray + 0.2f * along * along);
    if (weight > weights[0]) {
      weights[1] = weights[0];
      places[1] = places[0];
      weights[0] = weight;
      places[0] = place;
    } else if (weight > weights[1]) {
      weights[1] = weight;
      places[1] = place;
    }
  }
}

// True if a map has recorded a surface behind the point; else there is one at the point or in front of it.
bool is_seen_through(vec3 point, vec4 place) {
  vec3 to_point = point - place.xyz;
  float distance_m = length(to_point);
  return seen_distance(to_point / distance_m, place.w) > distance_m + slack_m(distance_m, height_grid.z);
}

// The height field is solid below bridges, balconies and arches. Where the ray hits the side of a cell and the best map has
// recorded a surface behind it, the ray continues with the next cell.
HeightHit walk_under(HeightGrid grid, vec3 at, vec3 direction, float reach, out vec4 places[2], out float weights[2]) {
  HeightHit hit = walk_pyramid(grid, at, direction, reach);
  choose_maps(at, direction, at + hit.distance * direction, places, weights);
  if (detail != all_detail) return hit;
  for (int i = 0; i < max_cells_under; ++i) {
    if (hit.met != met_side || !is_seen_through(at + hit.distance * direction, places[0])) break;
    float from = hit.distance + 0.01f * grid.cell_m;  // within the cell, which it leaves freely
    hit = walk_pyramid(grid, at + from * direction, direction, reach - from);
    hit.distance += from;
    choose_maps(at, direction, at + hit.distance * direction, places, weights);
  }
  return hit;
}

// Intersection with geometry that the height field lacks: trees and railings. Where the nearest map has recorded a surface in front
// of the hit, or the ray reached the sky, the ray marches through the map's depth, in growing steps, to the first point behind
// the recorded surface (relief mapping). Passing behind a silhouette is not a hit.
float hit_before(vec3 at, vec3 direction, float distance, vec4 place) {
  vec3 to_met = at + distance * direction - place.xyz;
  float met_m = length(to_met);
  bool may_be_hidden = distance > 0.99f * reach_m || seen_distance(to_met / met_m, place.w) < met_m - slack_m(met_m, height_grid.z);
  float near = 0.0f, far = first_step_m;
  bool was_before = true;
  for (int i = 0; may_be_hidden && far < distance && i < max_steps; ++i) {
    vec3 to_far = at + far * direction - place.xyz;
    float far_m = length(to_far);
    bool is_before = far_m < seen_distance(to_far / far_m, place.w);
    if (was_before && !is_before) {
      float low = near, high = far;
      for (int k = 0; k < 4; ++k) {
        float middle = 0.5f * (low + high);
        vec3 to_middle = at + middle * direction - place.xyz;
        float middle_m = length(to_middle);
        bool is_behind = middle_m > seen_distance(to_middle / middle_m, place.w);
        low = is_behind ? low : middle;
        high = is_behind ? middle : high;
      }
      vec3 to_high = at + high * direction - place.xyz;
      float high_m = length(to_high);
      if (abs(high_m - min_seen_distance(to_high / high_m, place.w)) < max_crossing_m) return high;
    }
    was_before = is_before;
    near = far;
    far *= step_growth;
  }
  return distance;
}

void trace(vec3 at, vec3 direction) {
  HeightGrid grid = HeightGrid(height_grid.xy, height_grid.z, ivec2(height_cells), int(height_grid.w));
  BodyHit body = BodyHit(reach_m, -1, vec3(0.0f), vec3(0.0f));
  if (detail == all_detail) body = meet_bodies(at, direction, reach_m);
  vec4 places[2];
  float weights[2];
  HeightHit hit = walk_under(grid, at, direction, body.distance, places, weights);
  float before = detail == all_detail ? hit_before(at, direction, hit.distance, place_of(maps_about(at).x)) : hit.distance;
  if (before < hit.distance) {
    hit = HeightHit(before, met_side);
    choose_maps(at, direction, at + before * direction, places, weights);
  }
  vec3 met = at + hit.distance * direction;
  sight.is_body = hit.met == met_nothing && body.body >= 0;
  if (sight.is_body) {
    sight.body_radiance = radiance_of_body(body, met, direction, places[0].w);
    return;
  }

  sight.distance = hit.distance;
  sight.is_ground = hit.met == met_top;
  if (hit.met == met_side && detail == all_detail)
    sight.distance = hit_on_map(at, direction, hit.distance, places[0].xyz, places[0].w);
  met = at + sight.distance * direction;
  for (int k = 0; k < 2; ++k) {
    sight.to_met[k] = met - places[k].xyz;
    sight.map[k] = places[k].w;
  }
  float second = weights[1] / (weights[0] + weights[1]);
  sight.weight[1] = second < min_weight || detail != all_detail ? 0.0f : second;
  sight.weight[0] = 1.0f - sight.weight[1];
  if (hit.met == met_top && hit.distance < shade_reach_m && detail == all_detail)
    sight.shade = share_left_by_bodies(met);
}

// Derivative of the mirror direction by pixels: the smaller of the two one-sided differences, so that silhouettes do not count.
vec3 change_of_way(vec3 way, ivec2 here, ivec2 step) {
  vec3 least = vec3(2.0f);
  for (int side = -1; side <= 1; side += 2) {
    vec4 there = texelFetch(ray_ways, clamp(here + side * step, ivec2(0), textureSize(ray_ways, 0) - ivec2(1)), 0);
    vec3 change = float(side) * (octahedral_direction(there.xy) - way);
    if (int(there.w) == reflecting_object + 1 && dot(change, change) < dot(least, least)) least = change;
  }
  return least.x < 2.0f ? least : vec3(0.0f);
}

void look_along(vec3 at, vec3 direction) {
  sight.is_body = false;
  sight.is_ground = false;
  sight.direction = direction;
  sight.shade = vec3(1.0f);
  sight.weight[1] = 0.0f;
  ivec2 here = ivec2(gl_FragCoord.xy);
  vec3 along_x = change_of_way(direction, here, ivec2(1, 0)), along_y = change_of_way(direction, here, ivec2(0, 1));
  bool is_wide_in_x = dot(along_x, along_x) > dot(along_y, along_y);
  sight.across = is_wide_in_x ? along_x : along_y;
  sight.narrow = length(is_wide_in_x ? along_y : along_x);
  if (detail < one_map) {
    look_into_nearest_map(at, direction);
  } else {
    trace(at, direction);
  }
  sight.across *= sight.distance;
  sight.narrow *= sight.distance;
}

// Anisotropic filtering: the footprint of a curved mirror is long and thin; lookups along its major axis, each as wide as its
// minor axis.
vec3 sharp_radiance(int k, float lobe) {
  float texels_a_m = layer_size.x / layer_rad / length(sight.to_met[k]);
  float wide = length(sight.across) * texels_a_m;
  float thin = sqrt(sight.narrow * sight.narrow * texels_a_m * texels_a_m + lobe * lobe);
  float taps = clamp(ceil(wide / max(thin, 1.0f)), 1.0f, max_taps);
  float level = log2(max(max(wide / taps, thin), 1.0f)) - 0.5f;
  vec3 sum = vec3(0.0f);
  for (float i = 0.5f; i < taps; ++i) {
    vec3 to_point = sight.to_met[k] + (i / taps - 0.5f) * sight.across;
    vec2 uv = layer_uv(normalize(to_point), layer_size.x, layer_size.y);
    sum += textureLod(map_colours, vec3(uv, sight.map[k]), level).rgb;
  }
  return sum / taps;
}

vec3 glossy_radiance(int k, vec3 direction, float roughness) {
  vec3 tiles = gloss_tiles(roughness);
  vec2 uv = layer_uv(direction, gloss_side, gloss_border);
  vec3 sharper = textureLod(map_glosses, vec3(gloss_uv(uv, tiles.x), sight.map[k]), 0.0f).rgb;
  vec3 rougher = textureLod(map_glosses, vec3(gloss_uv(uv, tiles.y), sight.map[k]), 0.0f).rgb;
  return mix(sharper, rougher, tiles.z);
}

// Radiance of the hit, prefiltered for a roughness. `over_ground`: the share of the lobe that passes above the ground hit by its
// centre, to surfaces behind it.
vec3 reflected_radiance(float roughness, float over_ground) {
  vec3 sum = vec3(0.0f);
  for (int k = 0; k < max_maps; ++k) {
    if (sight.weight[k] == 0.0f) continue;
    // A lobe that hits near the reflector is narrow as seen from a map farther away.
    float seen_roughness = roughness * sqrt(min(sight.distance / length(sight.to_met[k]), 1.0f));
    vec3 to_met = normalize(sight.to_met[k]);
    vec3 seen = seen_roughness < min_gloss ? sharp_radiance(k, lobe_texels(seen_roughness, layer_size.x))
                                             : glossy_radiance(k, to_met, seen_roughness);
    if (over_ground > 0.0f)
      seen = mix(seen, glossy_radiance(k, normalize(to_met + sight.direction), roughness), over_ground);
    sum += sight.weight[k] * seen;
  }
  return min(sight.is_body ? sight.body_radiance : sight.shade * sum, vec3(max_radiance));
}

void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  vec4 start = texelFetch(ray_starts, here, 0), way = texelFetch(ray_ways, here, 0);
  if (int(way.w) != reflecting_object + 1) discard;
  look_along(start.xyz, octahedral_direction(way.xy));
  bool passes_ground = sight.is_ground && start.w > min_wide_lobe;
  base_radiance = vec4(reflected_radiance(start.w, passes_ground ? share_over_ground : 0.0f), 1.0f);
  coat_radiance = reflected_radiance(way.z, 0.0f);
}
