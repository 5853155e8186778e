// Billboards of a tree's cells: the mathematics of their display (003_d5b01da2d2f805f6, section 4.6), for
// shaders and, as C++ (graphics/shading/glsl.h), for the fit of the textures and the evaluation on the CPU.
//
// A billboard faces the eye, upright, and is as large as the cell's silhouette; its texture holds one view of
// the cell.

/// The billboard's axis to the right, for a unit direction from the cell to the eye.
GLSL_FUNCTION vec3 billboard_right(vec3 to_eye) {
  vec2 level = vec2(-to_eye.y, to_eye.x);
  float size = length(level);
  return size > 1e-5f ? vec3(level.x / size, level.y / size, 0.0f) : vec3(1.0f, 0.0f, 0.0f);
}

/// Its axis upward.
GLSL_FUNCTION vec3 billboard_up(vec3 to_eye, vec3 right) { return cross(to_eye, right); }

/// Half of its width and height: the extents of a box with these half sizes, metres.
GLSL_FUNCTION vec2 billboard_half_size(vec3 right, vec3 up, vec3 cell_half_m) {
  return vec2(dot(abs(right), cell_half_m), dot(abs(up), cell_half_m));
}

/// The silhouette of the cell's box on its billboard, whose points are -1..1 to the right and upward (q):
/// within the rectangle it is where |dot(q, xy)| <= 1 and |dot(q, zw)| <= 1. Boxes of neighbouring cells
/// share the edges of their silhouettes, so that every ray passes exactly the billboards of the cells that it
/// passes.
GLSL_FUNCTION vec4 silhouette_slants(vec3 right, vec3 up, vec3 cell_half_m) {
  vec2 x = cell_half_m.x * vec2(right.x, up.x), y = cell_half_m.y * vec2(right.y, up.y);
  vec2 z = cell_half_m.z * vec2(right.z, up.z);
  float xy = abs(x.x * y.y - x.y * y.x), xz = abs(x.x * z.y - x.y * z.x), yz = abs(y.x * z.y - y.y * z.x);
  vec2 half_size_m = billboard_half_size(right, up, cell_half_m);
  vec2 along_x = half_size_m * vec2(x.y, -x.x) / max(xy + xz, 1e-12f);
  vec2 along_y = half_size_m * vec2(y.y, -y.x) / max(xy + yz, 1e-12f);
  return vec4(along_x.x, along_x.y, along_y.x, along_y.y);
}

/// How far out a point of the billboard (-1..1) lies: at most 1 within the silhouette.
GLSL_FUNCTION float silhouette_reach(vec2 q, vec4 slants) {
  float along_x = abs(q.x * slants.x + q.y * slants.y), along_y = abs(q.x * slants.z + q.y * slants.w);
  return max(max(abs(q.x), abs(q.y)), max(along_x, along_y));
}

/// Texture coordinates of a point of the billboard (-1..1); v runs downward.
GLSL_FUNCTION vec2 billboard_uv(vec2 q) { return vec2(0.5f + 0.5f * q.x, 0.5f - 0.5f * q.y); }

/// Weights of the two closest cameras from the angles (ascending, radians) of the three closest ones to the
/// eye's direction: (1 / p)(1 - p / p_third), as in unstructured lumigraphs, so that no camera enters or
/// leaves with a jump. At a camera's own place its weight is 1.
GLSL_FUNCTION vec2 two_closest_weights(vec3 angles) {
  float first = max(angles.x, 1e-6f), second = max(angles.y, first), third = max(angles.z, second);
  float a = (1.0f - first / third) / first, b = (1.0f - second / third) / second;
  return a + b > 0.0f ? vec2(a / (a + b), b / (a + b)) : vec2(0.5f, 0.5f);
}

/// Porter and Duff's over of premultiplied colours.
GLSL_FUNCTION vec4 over(vec4 front, vec4 behind) { return front + (1.0f - front.w) * behind; }

/// 0..1, as if at random, for a point of space: a surface of opacity alpha that is there where alpha exceeds
/// this lets the right share of light through in the mean of a pixel (Wyman and McGuire 2017, hashed alpha).
GLSL_FUNCTION float opacity_threshold(vec3 at) {
  vec3 p = fract(at * vec3(443.897f, 441.423f, 437.195f));
  float mixed = dot(p, vec3(p.y + 19.19f, p.z + 19.19f, p.x + 19.19f));
  p = p + vec3(mixed);
  return fract((p.x + p.y) * p.z);
}
