// What lies behind a flat surface, such as a window in its reveal: a ray goes on until it meets the relief
// that a texture gives, and the sun's light comes in only where the relief lets it (Policarpo et al. 2005,
// Real-Time Relief Mapping on Arbitrary Polygonal Surfaces). Openings with flat floors need few lookups: a
// floor is hit at once, and a wall that hides it is found by bisection. Needs texture_frame.glsl, and from
// the host:
//   float relief_depth(vec2 uv)   0: at the surface, 1: at the floor of the deepest

const float relief_tolerance = 0.03f;  // in depths: less is the same floor

// By how much texture coordinates change while `direction` passes through `depth_m` below the surface.
GLSL_FUNCTION vec2 uv_through_relief(TextureFrame frame, vec3 normal, vec3 direction, float depth_m) {
  float sinking = max(abs(dot(normal, direction)), 0.08f);
  vec3 along = (direction - normal * dot(normal, direction)) * (depth_m / sinking);
  vec3 across = cross(frame.step_1, frame.step_2);
  float area = dot(across, across);
  if (area < 1e-30f) return vec2(0.0f);
  return (dot(cross(along, frame.step_2), across) * frame.uv_1 +
          dot(cross(frame.step_1, along), across) * frame.uv_2) /
         area;
}

// Where a ray that comes to `uv` and moves by `uv_to_floor` until it is 1 deep meets the relief: its uv, and
// the depth.
GLSL_FUNCTION vec3 relief_hit(vec2 uv, vec2 uv_to_floor) {
  float deep = relief_depth(uv);
  if (deep < relief_tolerance) return vec3(uv.x, uv.y, 0.0f);
  float open = 0.0f;
  float met = relief_depth(uv + deep * uv_to_floor);
  for (int i = 0; i < 2; ++i) {  // over a step down to a deeper floor
    if (met <= deep + relief_tolerance) break;
    open = deep;
    deep = met;
    met = relief_depth(uv + deep * uv_to_floor);
  }
  if (met < deep - relief_tolerance) {
    // A view that grazes the surface moves by metres while it sinks: fewer halvings would leave the place so
    // far behind the edge of the opening that no light finds out.
    for (int i = 0; i < 10; ++i) {
      float middle = 0.5f * (open + deep);
      bool is_open = relief_depth(uv + middle * uv_to_floor) > middle;
      open = is_open ? middle : open;
      deep = is_open ? deep : middle;
    }
  }
  vec2 at = uv + deep * uv_to_floor;
  return vec3(at.x, at.y, deep);
}

// 1 where light comes in to a point of the relief, 0 where the edge of the opening keeps it out;
// `uv_to_floor` of the light's way back, toward its source.
GLSL_FUNCTION float relief_light(vec3 hit, vec2 uv_to_floor) {
  if (hit.z < relief_tolerance) return 1.0f;
  vec2 out_of_it = hit.z * uv_to_floor;
  vec2 at = vec2(hit.x, hit.y);
  float half_way = relief_depth(at + 0.5f * out_of_it) - 0.5f * hit.z;
  float above = relief_depth(at + out_of_it);
  float light = smoothstep(0.0f, 0.35f * hit.z, min(2.0f * half_way, above));
  // Joints of bricks and the rims of openings are narrower than pixels: their shade would be loose dark
  // specks.
  return mix(1.0f, light, smoothstep(2.0f * relief_tolerance, 4.0f * relief_tolerance, hit.z));
}

// Share of the relief's depth that is worth its lookups where a pixel is `pixel_m` wide: none far away.
GLSL_FUNCTION float relief_share(float pixel_m, float relief_m) {
  return 1.0f - smoothstep(0.3f, 0.6f, pixel_m / relief_m);
}
