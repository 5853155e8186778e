// The surface that a reference map has recorded (distance impostors, Szirmay-Kalos and others 2005): its
// distance, its intersection with a mirror ray, and what lies in front of or behind the height field. Needs
// the maps' uniforms and reference_maps/validity.glsl.

const float max_move_m = 2.5f;    // of a hit onto the recorded surface: heights have the resolution of a cell
const float first_step_m = 2.0f;  // when marching through a map's depth
const float step_growth = 1.4f;   // to 30 m
const int max_steps = 9;
const float max_crossing_m =
    2.0f;  // depth difference of a hit: at silhouettes the recorded depth jumps by more

float seen_distance(vec3 to_point, float map) {
  return textureLod(map_distances, vec3(layer_uv(to_point, layer_size.x, layer_size.y), map), 0.0f).r;
}

// Minimum distance over the bilinear footprint. Filtering distances across a silhouette invents surfaces
// between foreground and background; colour lookups suffer the same.
float min_seen_distance(vec3 to_point, float map) {
  vec2 texel = layer_uv(to_point, layer_size.x, layer_size.y) * layer_size.x - 0.5f;
  ivec3 low = ivec3(ivec2(clamp(texel, vec2(0.0f), layer_size.xx - 2.0f)), int(map));
  vec2 south =
      vec2(texelFetch(map_distances, low, 0).r, texelFetch(map_distances, low + ivec3(1, 0, 0), 0).r);
  vec2 north = vec2(texelFetch(map_distances, low + ivec3(0, 1, 0), 0).r,
                    texelFetch(map_distances, low + ivec3(1, 1, 0), 0).r);
  vec2 lower = min(south, north);
  return min(lower.x, lower.y);
}

// Intersection of the ray with the surface that a map has recorded: two steps of the secant method from the
// hit on the height field (distance impostors, Szirmay-Kalos and others 2005).
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

// True if a map has recorded a surface behind the point; else there is one at the point or in front of it.
bool is_seen_through(vec3 point, vec4 place) {
  vec3 to_point = point - place.xyz;
  float distance_m = length(to_point);
  return seen_distance(to_point / distance_m, place.w) > distance_m + slack_m(distance_m, height_grid.z);
}

// Intersection with geometry that the height field lacks: trees and railings. Where the nearest map has
// recorded a surface in front of the hit, or the ray reached the sky, the ray marches through the map's
// depth, in growing steps, to the first point behind the recorded surface (relief mapping). Passing behind a
// silhouette is not a hit.
float hit_before(vec3 at, vec3 direction, float distance, vec4 place) {
  vec3 to_hit = at + distance * direction - place.xyz;
  float hit_m = length(to_hit);
  bool may_be_hidden = distance > 0.99f * mirror_reach_m ||
                       seen_distance(to_hit / hit_m, place.w) < hit_m - slack_m(hit_m, height_grid.z);
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
