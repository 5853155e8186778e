// Billboards of a tree's cells: the mathematics of their display (003_d5b01da2d2f805f6, section 4.6), for shaders and, as
// C++ (graphics/shading/glsl.h), for the fit of the textures and the evaluation on the CPU.
//
// A billboard faces the eye, upright, and is as large as the cell's silhouette; its texture holds one view of the cell.

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

/// Texture coordinates of a point of the billboard, metres from its middle to the right and upward; v runs downward.
GLSL_FUNCTION vec2 billboard_uv(vec2 metres, vec2 half_size_m) {
  return vec2(0.5f + 0.5f * metres.x / half_size_m.x, 0.5f - 0.5f * metres.y / half_size_m.y);
}

/// Weights of the two closest cameras from the angles (ascending, radians) of the three closest ones to the eye's
/// direction: (1 / p)(1 - p / p_third), as in unstructured lumigraphs, so that no camera enters or leaves with a jump.
/// At a camera's own place its weight is 1.
GLSL_FUNCTION vec2 two_closest_weights(vec3 angles) {
  float first = max(angles.x, 1e-6f), second = max(angles.y, first), third = max(angles.z, second);
  float a = (1.0f - first / third) / first, b = (1.0f - second / third) / second;
  return a + b > 0.0f ? vec2(a / (a + b), b / (a + b)) : vec2(0.5f, 0.5f);
}

/// Porter and Duff's over of premultiplied colours.
GLSL_FUNCTION vec4 over(vec4 front, vec4 behind) { return front + (1.0f - front.w) * behind; }
