// The shade of a moving body on what lies near it: without it cars seem to float, for the baked light of the
// sky (sky_visibility.glsl) knows only the static scene. A body is a box as dense as what it stands for looks
// from each side (shading/body_shape.h). The share of a surface's sky that the box hides is exact where all
// of it stands above the surface's plane, as on a road: Lambert's formula over the box's outline (Quilez, box
// occlusion, 2014). What lies below the plane would take away from it, so the box is cut there, where one of
// its sides lies along the surface.

struct Body {
  vec4 box_from_world[3];  // rows: metres from the box's centre along its edges
  vec4 half_size_m;        // w: the object's index and 1
  vec4 coverage;           // xyz: the filled share 0..1 of the box as seen along each of its edges
};

const float body_reach_m = 3.0f;     // from the box: farther away its shade has faded
const float max_body_shade = 0.95f;  // some light gets everywhere
const float body_rim_m = 0.3f;  // so deep within a box a surface has forgotten the side that it looks through
const int max_bodies = 32;
const int bodies_per_cell = 4;  // as many as bytes in a word
const int body_cells_per_side = 48;
const float body_cell_m = 3.25f;

// Edge of the outline between two unit vectors: its share of Lambert's sum.
GLSL_FUNCTION vec3 outline_edge(vec3 from, vec3 to) {
  vec3 across = cross(from, to);
  float sine = length(across);
  return sine < 1e-6f ? vec3(0.0f) : across * (acos(clamp(dot(from, to), -1.0f, 1.0f)) / sine);
}

// The same for a point within the box, where a car reaches into a wall, whose bounds are larger than it is: a
// wall that cuts through a box has half of it before it, and a surface just behind a side that it looks
// through has all.
GLSL_FUNCTION float hidden_within_box(vec3 normal, vec3 side, vec3 depth_m) {
  vec3 at_side = max(vec3(1.0f) - depth_m / body_rim_m, vec3(0.0f));
  vec3 inward = max(-normal * side, vec3(0.0f)) * at_side;
  return 0.5f + 0.5f * max(inward.x, max(inward.y, inward.z));
}

// Share 0..1 of the cosine-weighted hemisphere about unit `normal` that a box hides from a point, in the
// box's frame.
GLSL_FUNCTION float hidden_by_box(vec3 point, vec3 normal, vec3 box_half_size) {
  vec3 depth_m = box_half_size - abs(point);
  vec3 nearest = 2.0f * step(vec3(0.0f), point) - vec3(1.0f);
  if (min(depth_m.x, min(depth_m.y, depth_m.z)) >= 0.0f) return hidden_within_box(normal, nearest, depth_m);

  vec3 on_plane = clamp(point, -box_half_size, box_half_size);
  vec3 cut = smoothstep(vec3(0.7f), vec3(0.95f), abs(normal));
  vec3 minimum = mix(-box_half_size, on_plane, cut * step(vec3(0.0f), normal));
  vec3 maximum = mix(box_half_size, on_plane, cut * step(normal, vec3(0.0f)));
  vec3 half_size = 0.5f * (maximum - minimum);
  vec3 p = point - 0.5f * (minimum + maximum);
  vec3 beyond = abs(p) - half_size;
  vec3 side = 2.0f * step(vec3(0.0f), p) - vec3(1.0f);
  vec3 corner = side * half_size;
  // A point that sees one or two faces sees an outline of four or six corners; these moves keep it convex.
  vec3 s = 2.0f * step(beyond, vec3(0.0f)) - vec3(1.0f);
  vec3 v0 = normalize(vec3(1.0f, 1.0f, -1.0f) * corner - p);
  vec3 v1 = normalize(vec3(1.0f, s.x, s.x) * corner - p);
  vec3 v2 = normalize(vec3(1.0f, -1.0f, 1.0f) * corner - p);
  vec3 v3 = normalize(vec3(s.z, s.z, 1.0f) * corner - p);
  vec3 v4 = normalize(vec3(-1.0f, 1.0f, 1.0f) * corner - p);
  vec3 v5 = normalize(vec3(s.y, 1.0f, s.y) * corner - p);
  vec3 sum = outline_edge(v0, v1) + outline_edge(v1, v2) + outline_edge(v2, v3) + outline_edge(v3, v4) +
             outline_edge(v4, v5) + outline_edge(v5, v0);
  float turn = side.x * side.y * side.z;  // which way round the corners go
  return clamp(turn * dot(normal, sum) / 6.28318531f, 0.0f, 1.0f);
}

// Share of its sky that a body leaves to a surface in the world.
GLSL_FUNCTION float sky_share_beside(Body body, vec3 position, vec3 normal) {
  vec4 at = vec4(position, 1.0f);
  vec3 p =
      vec3(dot(body.box_from_world[0], at), dot(body.box_from_world[1], at), dot(body.box_from_world[2], at));
  vec4 along = vec4(normal, 0.0f);
  vec3 n = vec3(dot(body.box_from_world[0], along), dot(body.box_from_world[1], along),
                dot(body.box_from_world[2], along));
  vec3 half_size = vec3(body.half_size_m.x, body.half_size_m.y, body.half_size_m.z);
  vec3 beyond = max(abs(p) - half_size, vec3(0.0f));
  float distance_m = length(beyond);
  vec3 seen =
      beyond + vec3(0.01f);  // the more of a side is seen, the farther it is beyond; from within all alike
  float filled =
      dot(seen, vec3(body.coverage.x, body.coverage.y, body.coverage.z)) / (seen.x + seen.y + seen.z);
  float strength =
      max_body_shade * filled * (1.0f - smoothstep(0.3f * body_reach_m, body_reach_m, distance_m));
  return 1.0f - strength * hidden_by_box(p, n, half_size);
}

// What a place sees of the sky (sky_visibility.glsl), beside bodies that leave it a share.
GLSL_FUNCTION vec4 shaded_cell(vec4 cell, float share) {
  vec3 half_cell = vec3(0.5f);
  return vec4(half_cell + share * (vec3(cell.x, cell.y, cell.z) - half_cell), share * cell.w);
}
