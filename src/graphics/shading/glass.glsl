// Solid glass: smooth, without a colour of its own. Light at its surface is reflected or refracted by Snell's
// law, in fractions by Schlick's weight, which is the same from both sides. Shared by shaders and ray tracer.
// Needs surface.glsl.

GLSL_FUNCTION float glass_f0(float ior) {
  return (ior - 1.0f) * (ior - 1.0f) / ((ior + 1.0f) * (ior + 1.0f));
}

// The surface as one that reflects like glass; what comes through is light that it sends out, like emission.
GLSL_FUNCTION Surface glass_surface(Surface s, float ior) {
  s.base_colour = vec3(glass_f0(ior));
  s.metallic = 1.0f;
  s.clear_coat = 0.0f;
  s.translucency = 0.0f;
  return s;
}

// Where a ray goes on behind a surface. `direction` and `normal` of unit length, the normal against the
// direction; `ratio`: the index of refraction before the surface over the one behind it. Zero where all light
// is reflected.
GLSL_FUNCTION vec3 refracted(vec3 direction, vec3 normal, float ratio) {
  float cosine = -dot(direction, normal);
  float squared = 1.0f - ratio * ratio * (1.0f - cosine * cosine);
  if (squared <= 0.0f) return vec3(0.0f);
  return normalize(ratio * direction + (ratio * cosine - sqrt(squared)) * normal);
}

// Share of light from within that the surface sends back, by the cosine of the angle at which it would leave.
GLSL_FUNCTION float inner_reflectance(float ior, float cosine_outside) {
  float f0 = glass_f0(ior);
  return f0 + (1.0f - f0) * schlick_weight(cosine_outside);
}
