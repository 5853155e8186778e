// From exposed radiance to display light in 0..1, before sRGB encoding. Hable's filmic curve (2010) has a toe
// and a shoulder; it is scaled so that `white` comes out as 1.

GLSL_FUNCTION vec3 hable(vec3 x) {
  return (x * (0.22f * x + vec3(0.03f)) + vec3(0.002f)) / (x * (0.22f * x + vec3(0.3f)) + vec3(0.06f)) -
         vec3(0.0333333f);
}

// Weight of a sample among those of its pixel: bright ones count for about as much as they display.
GLSL_FUNCTION float sample_weight(vec3 exposed) {
  return 1.0f / (1.0f + dot(exposed, vec3(0.2126f, 0.7152f, 0.0722f)));
}

GLSL_FUNCTION vec3 tone_mapped(vec3 exposed) {
  const float white = 8.0f;
  return clamp(hable(max(exposed, vec3(0.0f))) / hable(vec3(white)), vec3(0.0f), vec3(1.0f));
}
