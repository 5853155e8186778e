// Intersection of a ray with a dynamic body (a car, a walker), beside the heightfield of the static scene:
// the distance from the body's surface, sampled in a box of cells (sphere tracing, Hart 1996). From the host:
//   float field_distance(vec3 cell, int field)   metres from the surface, below 0 within;
//                                                `cell` in cells from the box's corner

const vec3 field_cells = vec3(96.0f, 48.0f, 40.0f);
const float field_reach = 3.5f;  // cells: so far from the surface distances are known, and cut off beyond
const int max_field_steps = 40;
const float min_field_step_m = 0.01f;
const float field_clearance =
    0.5f;  // cells: a ray that starts on the body has left it when it is so far away
const float own_from_cells = 1.0f, own_whole_cells = 3.0f;  // own_share

GLSL_FUNCTION float field_reach_m(vec3 half_size_m) {
  vec3 cell_m = 2.0f * half_size_m / field_cells;
  return field_reach * max(cell_m.x, max(cell_m.y, cell_m.z));
}

// A field is too coarse to say what a body reflects of its own surface close by: there its reflection of
// itself fades.
GLSL_FUNCTION float own_share(float distance_m, vec3 half_size_m) {
  return smoothstep(own_from_cells, own_whole_cells, distance_m * field_reach / field_reach_m(half_size_m));
}

GLSL_FUNCTION vec3 field_cell(vec3 point_m, vec3 half_size_m) {
  return (point_m / half_size_m * 0.5f + vec3(0.5f)) * field_cells;
}

// Distances at which a ray enters and leaves a box about the origin; the second is the lesser where it
// misses.
GLSL_FUNCTION vec2 ray_in_box(vec3 origin, vec3 direction, vec3 half_size_m) {
  vec3 inverse = vec3(1.0f) / (direction + vec3(1e-9f));
  vec3 low = (-half_size_m - origin) * inverse;
  vec3 high = (half_size_m - origin) * inverse;
  vec3 enters = min(low, high), leaves = max(low, high);
  return vec2(max(max(enters.x, enters.y), max(enters.z, 0.0f)), min(leaves.x, min(leaves.y, leaves.z)));
}

// The distance along a unit direction at which the ray hits the body, in the frame of its box; `reach_m`
// where it does not. A ray that starts on the body (`is_own`) may hit it once it has left it.
GLSL_FUNCTION float distance_to_body(vec3 origin, vec3 direction, vec3 half_size_m, int field, float reach_m,
                                     bool is_own) {
  vec2 within = ray_in_box(origin, direction, half_size_m);
  float to = min(within.y, reach_m);
  float at = within.x;
  float clearance_m = field_clearance * field_reach_m(half_size_m) / field_reach;
  bool has_left = !is_own;
  for (int i = 0; i < max_field_steps && at < to; ++i) {
    float off_m = field_distance(field_cell(origin + at * direction, half_size_m), field);
    if (has_left && off_m < min_field_step_m) return at;
    has_left = has_left || off_m > clearance_m;
    at += max(abs(off_m), 2.0f * min_field_step_m);
  }
  return reach_m;
}
