// The sky picture and the air: where a direction falls in an equirectangular picture, the diffuse light of
// the sky from nine spherical harmonics (Ramamoorthi and Hanrahan 2001), and haze.

// Texture coordinates (v downward) of a unit direction in the world (x east, y north, z up). The middle of
// the picture looks north, turned clockwise by `heading` radians.
GLSL_FUNCTION vec2 equirect_uv(vec3 direction, float heading) {
  float azimuth = atan(direction.x, direction.y) - heading;
  float u = 0.5f + azimuth / 6.28318531f;
  return vec2(fract(u), acos(clamp(direction.z, -1.0f, 1.0f)) / 3.14159265f);
}

// Irradiance on a surface with unit `normal`; `sh` are the coefficients already convolved with the cosine
// lobe.
GLSL_FUNCTION vec3 sky_irradiance(vec3 sh[9], vec3 normal) {
  float x = normal.x;
  float y = normal.y;
  float z = normal.z;
  vec3 sum = 0.282095f * sh[0] + 0.488603f * (y * sh[1] + z * sh[2] + x * sh[3]) +
             1.092548f * (x * y * sh[4] + y * z * sh[5] + x * z * sh[7]) +
             0.315392f * (3.0f * z * z - 1.0f) * sh[6] + 0.546274f * (x * x - y * y) * sh[8];
  return max(sum, vec3(0.0f));
}

// Level of the prefiltered sky picture for a roughness; shading/sky.h fills level n for roughness n / (levels
// - 1).
GLSL_FUNCTION float sky_level(float roughness, float levels) {
  return clamp(roughness, 0.0f, 1.0f) * (levels - 1.0f);
}

// Radiance after `distance_m` of air that scatters `haze_radiance` into the view.
GLSL_FUNCTION vec3 through_haze(vec3 radiance, float distance_m, float haze_per_m, vec3 haze_radiance) {
  return mix(haze_radiance, radiance, exp(-haze_per_m * distance_m));
}
