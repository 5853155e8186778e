// Reflections from reference maps (Meyer and Loscos 2003, sections 4.1 to 4.3), per pixel. The mirror ray is
// traced from the surface through the city's height field; the hit is moved onto the surface that the maps
// have recorded, and looked up in the two maps that show it best:
//   radiance = shade * sum_k w_k map_k(hit - place_k, footprint)
//   w_k ~ validity_k / (0.5 + d_k^2 + 0.2 a_k^2)
// d_k: distance of map k from the ray, a_k: along the ray, metres; shade: what dynamic objects leave of the
// light on the ground.
#include "graphics/render/frame.glsl"
#include "graphics/render/body_lookup.glsl"
#include "graphics/render/bounced_lookup.glsl"
#include "graphics/render/lamp_lookup.glsl"
#include "graphics/render/sky_lookup.glsl"
#include "graphics/render/sun_lookup.glsl"
#include "graphics/shading/octahedral.glsl"
#include "graphics/shading/surface.glsl"
#include "graphics/shading/lighting.glsl"
#include "reflections/reference_maps/map_levels.glsl"

layout(location = 0) out vec4 base_radiance;  // alpha 1: the pixel reflects
layout(location = 1) out vec3 coat_radiance;

#include "reflections/environment_rays/map_uniforms.glsl"
#include "reflections/environment_rays/ray_detail.glsl"

const int max_cells_under = 8;  // maximum number of cells that a ray passes under a bridge or an arch
#ifndef DETAIL
#define DETAIL 2
#endif
const int detail = DETAIL;
const int max_maps = detail == all_detail ? 2 : 1;
const float min_wide_lobe = 0.3f;  // roughness
const float share_over_ground = 0.4f;
const float min_weight = 0.05f;     // a second map with less is skipped
const float shade_reach_m = 25.0f;  // ground up to this distance is shaded by dynamic objects

// What the pixel's mirror ray hits, as two maps show it.
struct Reflected {
  vec3 from_map[2];  // vectors from the maps to the hit
  float map[2];
  float weight[2];
  float distance;
  vec3 across;       // major axis of the pixel's footprint at the hit, metres
  float narrow;      // length of its minor axis, metres
  vec3 direction;    // of the mirror ray
  bool is_ground;    // the ray hits the top of a cell
  vec3 shade;        // fraction of its light that dynamic objects leave
  float body_share;  // of a dynamic object, which no map shows: 1 where the ray hits one
  vec3 body_radiance;
  float open_sky;  // share of the sky picture: 1 where the ray reaches the sky, which something hides from
                   // the maps
};
Reflected reflected;

float cell_height(ivec2 cell, int level) { return texelFetch(heights, cell, level).r; }

#include "reflections/reference_maps/heightfield_walk.glsl"
#include "reflections/reference_maps/validity.glsl"
#include "reflections/environment_rays/mirrored_bodies.glsl"
#include "reflections/environment_rays/map_surface.glsl"
#include "reflections/environment_rays/map_selection.glsl"
#include "reflections/environment_rays/dynamic_light.glsl"
#include "reflections/environment_rays/map_radiance.glsl"

// The height field is solid below bridges, balconies and arches. Where the ray hits the side of a cell and
// the best map has recorded a surface behind it, the ray continues with the next cell.
HeightHit walk_under(HeightfieldGrid grid, vec3 at, vec3 direction, float reach, out vec4 places[2],
                     out float weights[2], out float seen) {
  HeightHit hit;
  float from = 0.0f;
  bool continues;
  int passed = 0;
  do {
    hit = walk_pyramid(grid, at + from * direction, direction, reach - from);
    hit.distance += from;
    seen = choose_maps(at, direction, at + hit.distance * direction, places, weights);
    continues = detail == all_detail && passed < max_cells_under && hit.kind == hit_side &&
                is_seen_through(at + hit.distance * direction, places[0]);
    from = hit.distance + 0.01f * grid.cell_m;  // inside the cell, which the ray then leaves without a hit
    ++passed;
  } while (continues);
  return hit;
}

// For reflectors that are small in the image: the hit is assumed at the distance that the nearest map has
// recorded in the ray's direction.
void look_into_nearest_map(vec3 at, vec3 direction) {
  vec4 place = place_of(maps_around(at).x);
  reflected.distance = seen_distance(direction, place.w);
  reflected.from_map[0] = at + reflected.distance * direction - place.xyz;
  reflected.map[0] = place.w;
  reflected.weight[0] = 1.0f;
}

// Section 4.2: the hit on the height field, or in front of it on what only the maps have recorded; and the
// two maps that show it best. `seen`: how well one of them does.
HeightHit hit_of_ray(vec3 at, vec3 direction, float reach, out vec4 places[2], out float weights[2],
                     out float seen) {
  HeightfieldGrid grid =
      HeightfieldGrid(height_grid.xy, height_grid.z, ivec2(height_cells), int(height_grid.w));
  HeightHit hit = walk_under(grid, at, direction, reach, places, weights, seen);
  float before = detail == all_detail ? hit_before(at, direction, hit.distance, place_of(maps_around(at).x))
                                      : hit.distance;
  if (before < hit.distance) {
    hit = HeightHit(before, hit_side);
    seen = choose_maps(at, direction, at + before * direction, places, weights);
  }
  return hit;
}

// Section 4.3: the point is looked up in the maps that show it best, by their weights.
void look_into_maps(vec3 point, vec4 places[2], float weights[2]) {
  for (int k = 0; k < 2; ++k) {
    reflected.from_map[k] = point - places[k].xyz;
    reflected.map[k] = places[k].w;
  }
  float second = weights[1] / (weights[0] + weights[1]);
  reflected.weight[1] = second < min_weight || detail != all_detail ? 0.0f : second;
  reflected.weight[0] = 1.0f - reflected.weight[1];
}

// Sets what dynamic objects change: the radiance of the one that is hit, and the shade on the ground. Of most
// rays one is wanted or none: both take their light from one place in the code, which a second round serves
// only where a ray shows both.
void light_dynamic_parts(BodyHit body, bool wants_body, vec3 body_point, bool wants_ground, vec3 ground_point,
                         float map) {
  bool continues;
  do {
    vec3 point = wants_body ? body_point : ground_point;
    vec3 normal = wants_body ? body.normal : vec3(0.0f, 0.0f, 1.0f);
    PlaceLight light = light_at(point, normal, wants_body ? point : above_ground(point));
    continues = wants_body && wants_ground;
    if (wants_body) {
      reflected.body_radiance = radiance_of_body(body, reflected.direction, map, light);
    } else if (wants_ground) {
      reflected.shade = light_left_by_bodies(point, normal, light);
    }
    wants_body = false;
  } while (continues);
}

// A dynamic object in front of all that the maps show, or the surface that the best map has recorded at the
// hit.
void trace_mirror_ray(vec3 at, vec3 direction) {
  BodyHit body = BodyHit(mirror_reach_m, -1, 1.0f, vec3(0.0f), vec3(0.0f));
  if (detail == all_detail) body = intersect_bodies(at, direction, mirror_reach_m);
  vec4 places[2];
  float weights[2], seen;
  bool is_whole = body.share == 1.0f;
  HeightHit hit = hit_of_ray(at, direction, is_whole ? body.distance : mirror_reach_m, places, weights, seen);
  bool hits_body = body.body >= 0 && (is_whole ? hit.kind == hit_nothing : hit.distance > body.distance);
  reflected.body_share = hits_body ? body.share : 0.0f;
  reflected.distance = hit.distance;
  reflected.is_ground = hit.kind == hit_top;
  reflected.open_sky = hit.kind == hit_nothing ? 1.0f - seen : 0.0f;
  if (hit.kind == hit_side && detail == all_detail)
    reflected.distance = hit_on_map(at, direction, hit.distance, places[0].xyz, places[0].w);
  vec3 point = at + reflected.distance * direction;
  look_into_maps(point, places, weights);
  if (detail == all_detail)
    light_dynamic_parts(body, hits_body, at + body.distance * direction,
                        reflected.is_ground && hit.distance < shade_reach_m, point, places[0].w);
}

// Derivative of the mirror direction with respect to pixels: the smaller of the two one-sided differences, so
// that silhouettes do not count.
vec3 change_of_direction(vec3 direction, ivec2 here, ivec2 step) {
  vec3 smaller = vec3(2.0f);
  for (int side = -1; side <= 1; side += 2) {
    ivec2 pixel = clamp(here + side * step, ivec2(0), textureSize(ray_directions, 0).xy - ivec2(1));
    vec4 there = texelFetch(ray_directions, ivec3(pixel, ray_layer), 0);
    vec3 change = float(side) * (octahedral_direction(there.xy) - direction);
    if (int(there.w) == reflecting_object + 1 && dot(change, change) < dot(smaller, smaller))
      smaller = change;
  }
  return smaller.x < 2.0f ? smaller : vec3(0.0f);
}

// Fills `reflected` for the mirror ray from `at`.
void look_along(vec3 at, vec3 direction) {
  reflected.body_share = 0.0f;
  reflected.body_radiance = vec3(0.0f);
  reflected.is_ground = false;
  reflected.open_sky = 0.0f;
  reflected.direction = direction;
  reflected.shade = vec3(1.0f);
  reflected.weight[1] = 0.0f;
  ivec2 here = ivec2(gl_FragCoord.xy);
  vec3 along_x = change_of_direction(direction, here, ivec2(1, 0));
  vec3 along_y = change_of_direction(direction, here, ivec2(0, 1));
  bool is_wide_in_x = dot(along_x, along_x) > dot(along_y, along_y);
  reflected.across = is_wide_in_x ? along_x : along_y;
  reflected.narrow = length(is_wide_in_x ? along_y : along_x);
  if (detail < one_map) {
    look_into_nearest_map(at, direction);
  } else {
    trace_mirror_ray(at, direction);
  }
  reflected.across *= reflected.distance;
  reflected.narrow *= reflected.distance;
}

// Radiance of the hit, prefiltered for the roughness of both layers. `over_ground`: the share of the base's
// lobe that passes above the ground hit by its centre, to surfaces behind it.
LayerRadiance reflected_radiance(vec2 roughness, float over_ground) {
  LayerRadiance sum = LayerRadiance(vec3(0.0f), vec3(0.0f));
  MapView view = MapView(reflected.from_map[0], reflected.map[0]);
  float weight = reflected.weight[0];
  int k = 0;
  do {
    LayerRadiance seen = radiance_in_map(view, roughness, over_ground);
    sum.base += weight * seen.base;
    sum.coat += weight * seen.coat;
    view = MapView(reflected.from_map[1], reflected.map[1]);
    weight = reflected.weight[1];
    ++k;
  } while (k < max_maps && weight > 0.0f);
  return sum;
}

// What of it is seen: beside dynamic objects and the open sky.
vec3 seen_radiance(vec3 in_maps, float roughness) {
  vec3 behind = mix(in_maps, sky_radiance(reflected.direction, roughness), reflected.open_sky);
  return min(mix(reflected.shade * behind, reflected.body_radiance, reflected.body_share),
             vec3(max_radiance));
}

void main() {
  ivec3 here = ivec3(ivec2(gl_FragCoord.xy), ray_layer);
  vec4 start = texelFetch(ray_starts, here, 0), ray = texelFetch(ray_directions, here, 0);
  if (int(ray.w) != reflecting_object + 1) discard;
  look_along(start.xyz, octahedral_direction(ray.xy));
  bool passes_ground = reflected.is_ground && start.w > min_wide_lobe;
  LayerRadiance in_maps = reflected_radiance(vec2(start.w, ray.z), passes_ground ? share_over_ground : 0.0f);
  base_radiance = vec4(seen_radiance(in_maps.base, start.w), 1.0f);
  coat_radiance = seen_radiance(in_maps.coat, ray.z);
}
