// Surfaces, lights and directions that differ from case to case, shaded by every shared function.

// In 0..1, from whole numbers below 64 without loss in single precision.
GLSL_FUNCTION float case_number(float x, float y, float which) {
  return fract((x * 13.0f + y * 29.0f + which * 7.0f + 3.0f) / 61.0f);
}

GLSL_FUNCTION vec3 case_direction(float x, float y, float which) {
  vec3 d = vec3(case_number(x, y, which), case_number(x, y, which + 1.0f), case_number(x, y, which + 2.0f));
  return normalize(2.0f * d - vec3(0.97f));
}

GLSL_FUNCTION vec3 checked_shading(float x, float y) {
  Surface s;
  s.normal = case_direction(x, y, 1.0f);
  s.base_colour = vec3(case_number(x, y, 4.0f), case_number(x, y, 5.0f), case_number(x, y, 6.0f));
  s.metallic = step(0.5f, case_number(x, y, 7.0f));
  s.roughness = 0.2f + 0.8f * case_number(x, y, 8.0f);
  s.clear_coat = case_number(x, y, 9.0f);
  s.clear_coat_roughness = 0.2f;
  s.translucency = case_number(x, y, 10.0f);
  s.occlusion = case_number(x, y, 11.0f);
  s.emission = vec3(0.1f * case_number(x, y, 12.0f));

  SceneLight light;
  light.to_sun = case_direction(x, y, 13.0f);
  light.sun_irradiance = vec3(3.0f, 2.75f, 2.35f);
  for (int i = 0; i < 9; ++i) light.sky_sh[i] = vec3(case_number(x, y, 16.0f + float(i)));
  light.bounced = vec3(0.3f * case_number(x, y, 40.0f), 0.1f, 0.2f);
  light.bounced_behind = vec3(0.1f, 0.2f, 0.3f * case_number(x, y, 41.0f));
  light.haze_radiance = vec3(0.5f, 0.6f, 0.7f);
  light.haze_per_m = 0.002f;

  vec3 viewer = case_direction(x, y, 30.0f);
  vec3 to_viewer = dot(viewer, s.normal) < 0.0f ? -viewer : viewer;
  vec4 cell = vec4(case_number(x, y, 33.0f), case_number(x, y, 34.0f), case_number(x, y, 35.0f),
                   case_number(x, y, 36.0f));
  vec3 reflection = vec3(sky_share_of_direction(cell, reflect(-to_viewer, s.normal)));
  vec3 lit = lit_radiance(s, light, to_viewer, case_number(x, y, 37.0f), sky_share_of_normal(cell, s.normal),
                          reflection, 0.5f * reflection);
  vec3 hazy = through_haze(lit, 1000.0f * case_number(x, y, 38.0f), light.haze_per_m, light.haze_radiance);
  vec2 uv = equirect_uv(case_direction(x, y, 39.0f), 0.3f);
  return tone_mapped(hazy) + vec3(0.01f * sample_weight(hazy), 0.01f * uv.y, 0.0f);
}
