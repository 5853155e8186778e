// Light that a photograph has recorded, turned back into radiance. GLSL that is C++, too; goes with
// tone_curve.glsl.

// The exposed radiance that `tone_mapped` shows as this display light, 0..1: its inverse.
GLSL_FUNCTION vec3 tone_unmapped(vec3 display) {
  const float white = 8.0f;
  vec3 a = display * hable(vec3(white)) + vec3(0.0333333f);
  vec3 square = 0.22f * (vec3(1.0f) - a), middle = vec3(0.03f) - 0.3f * a, rest = vec3(0.002f) - 0.06f * a;
  vec3 root = sqrt(max(middle * middle - 4.0f * square * rest, vec3(0.0f)));
  return max((root - middle) / (2.0f * square), vec3(0.0f));
}

// The same of sRGB, 0..1, as it is encoded: a quotient of polynomials in place of powers and roots. Displayed
// again, its error is below 0.1 of 255 steps.
GLSL_FUNCTION vec3 srgb_tone_unmapped(vec3 s) {
  vec3 above = s * (vec3(0.20803895f) + s * (vec3(-0.20182983f) + s * (vec3(30.3563599f) + 17.2270078f * s)));
  vec3 below = vec3(1.0f) + s * (vec3(5.56131406f) + s * (vec3(79.0494510f) - 79.6366734f * s));
  return above / below;
}
