// Which photographs colour a point of a surface, and how much each (thesis 3.6.2; weights after Debevec et
// al. 1998 and Buehler et al. 2001, unstructured lumigraph rendering). GLSL that is C++, too
// (shading/glsl.h).

// Penalty of angle beyond which a photograph says nothing about a point, radians.
#define MAX_PENALTY 3.2f
// Keeps the weight of a photograph that is seen from its own viewpoint finite: it then outweighs all others
// by far.
#define MIN_PENALTY 1e-4f

// Angle between unit vectors, radians. Stable for small angles, where acos(dot) is not.
GLSL_FUNCTION float angle_between(vec3 a, vec3 b) {
  return 2.0f * atan(length(a - b) / max(length(a + b), 1e-20f));
}

// Penalty of a photograph that looks at a point from an angle to the eye, radians: the angle, and
// `resolution_weight` for each doubling of the size of the photograph's pixels on the surface over the
// display's. A photograph that is finer than needed is not penalised.
GLSL_FUNCTION float penalty_of_angle(float angle, float pixel_size_ratio, float resolution_weight) {
  return max(angle + resolution_weight * max(log2(max(pixel_size_ratio, 1e-6f)), 0.0f), MIN_PENALTY);
}

// The same from the directions from the point to the eye and to the photograph's camera (unit vectors).
GLSL_FUNCTION float view_penalty(vec3 to_eye, vec3 to_photograph, float pixel_size_ratio,
                                 float resolution_weight) {
  return penalty_of_angle(angle_between(to_eye, to_photograph), pixel_size_ratio, resolution_weight);
}

// Weight of a photograph among the k best: zero where it stops being one of them (max_penalty is that of the
// next one), so that nothing jumps when the eye moves.
GLSL_FUNCTION float blend_weight(float penalty, float max_penalty) {
  return max(1.0f - penalty / max_penalty, 0.0f) / penalty;
}

// 0 at the border of a picture of `size` pixels, 1 at `feather` pixels from it.
GLSL_FUNCTION float border_feather(vec2 pixel, vec2 size, float feather) {
  vec2 inside = min(pixel, size - pixel);
  return clamp(min(inside.x, inside.y) / feather, 0.0f, 1.0f);
}

// 1 where a point at linear depth `depth` is the surface that a photograph sees at `seen_depth`, 0 where that
// hides it; the tolerance is a part of the depth. Smooth between one and two tolerances.
GLSL_FUNCTION float not_hidden(float depth, float seen_depth, float tolerance) {
  return 1.0f - smoothstep(1.0f, 2.0f, (depth - seen_depth) / (tolerance * depth));
}

// How far the four pixels that a bilinear lookup mixes show one surface: at silhouettes they mix it with what
// lies before or behind, and another photograph is better, if there is one. `depths` are those of the four,
// `depth` the point's.
GLSL_FUNCTION float not_mixed(float depth, vec4 depths, float tolerance) {
  vec4 d = abs(depths - vec4(depth)) / (tolerance * depth);
  return mix(0.02f, 1.0f, 1.0f - smoothstep(1.0f, 2.0f, max(max(d.x, d.y), max(d.z, d.w))));
}

// A value that differs about as much as what is seen of it does: the square root of linear light is near sRGB
// and cheap.
GLSL_FUNCTION vec3 perceived(vec3 linear) { return sqrt(max(linear, vec3(0.0f))); }

// How much photographs contradict each other about a point: standard deviation of their perceived colours, by
// the channel that deviates most. `mean_of_squares` and `mean` are of the perceived colours, with the weights
// of the blend.
GLSL_FUNCTION float contradiction(vec3 mean_of_squares, vec3 mean) {
  vec3 variance = max(mean_of_squares - mean * mean, vec3(0.0f));
  return sqrt(max(variance.x, max(variance.y, variance.z)));
}
