// How two reference maps a and b share in what they both show of a point (Meyer and Loscos 2003, sections 4.1
// and 4.3).

// By the point's place along the line from one map to the other: W = 1 - D of the paper. There D is clamped,
// and beyond either end the sum falls below 1 and to nothing one length on; here the point's projection is
// clamped onto the segment, so that W_a + W_b = 1 everywhere, as the paper says it is.
GLSL_FUNCTION vec2 projected_weights(vec3 met, vec3 place_a, vec3 place_b) {
  vec3 between = place_b - place_a;
  float along = clamp(dot(met - place_a, between) / max(dot(between, between), 1e-6f), 0.0f, 1.0f);
  return vec2(1.0f - along, along);
}

// A map that sees a point counts for at least so much: beside one that does not, it has it alone.
const float min_weight = 1e-3f;

// The weights once each map's validity (0: something hides the point from it) is known; they sum to 1. Where
// no map sees the point, the one with the highest weight before the test.
GLSL_FUNCTION vec2 valid_weights(vec2 projected, vec2 validities) {
  vec2 weights = max(projected, vec2(min_weight)) * validities;
  float sum = weights.x + weights.y;
  if (sum < 0.1f * min_weight) return projected.x >= projected.y ? vec2(1.0f, 0.0f) : vec2(0.0f, 1.0f);
  return weights / sum;
}
