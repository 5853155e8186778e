// Shadows that fall on a photographed surface: of things that its photographs do not show. GLSL that is C++,
// too.

// The share of its light that a point keeps where the sun is hidden from it. Light that was recorded in a
// shadow keeps all: it is not darkened twice. `lit` is the luminance of the surface in the sun, 0 where that
// is not known, and `kept` what is left of it in its shadows; brighter than the mean of both (of their
// logarithms) is taken to be in the sun.
GLSL_FUNCTION float kept_in_shadow_of(float kept, float lit, vec3 recorded) {
  float luminance = dot(recorded, vec3(0.2126f, 0.7152f, 0.0722f));
  float dark = kept * lit, middle = sqrt(kept) * lit;
  return lit > 0.0f ? mix(1.0f, kept, smoothstep(dark, max(middle, dark + 1e-6f), luminance)) : kept;
}

// The same of a point that sees `visible` of the sun (0..1), at `facing`, the cosine between its normal and
// the sun: where the sun grazes, it brings nothing that could be taken away.
GLSL_FUNCTION float kept_recorded_light(float kept, float facing, float visible) {
  return mix(1.0f, kept, (1.0f - visible) * smoothstep(0.0f, 0.15f, facing));
}
