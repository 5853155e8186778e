// The clear sky as a picture of directions: sunlight scattered by the atmosphere (graphics/light/sky_view.h
// fills the table), the glare of the haze about the sun, and the sun's disc. Colours are CIE XYZ.
//
// Includers define sky_view_texel(int layer, ivec2 place): the table, 2 layers (what is scattered; haze that
// scattered once, without its phase function) of 40 columns (azimuth from the sun, 0 to pi) and 64 rows (32
// elevations above the horizon, then 32 below it).

// Elevations lie close at the horizon (Hillaire 2020): row 0 is level, the last one vertical.
GLSL_FUNCTION vec3 sky_view_lookup(int layer, vec3 direction, vec3 to_sun) {
  float half_rows = 32.0f;
  float elevation = asin(clamp(direction.z, -1.0f, 1.0f));
  float row = sqrt(abs(elevation) / 1.57079633f) * (half_rows - 1.0f);
  float first = direction.z < 0.0f ? half_rows : 0.0f;
  float level = length(vec2(direction.x, direction.y)) * length(vec2(to_sun.x, to_sun.y));
  float cosine = level > 1e-9f ? (direction.x * to_sun.x + direction.y * to_sun.y) / level : 1.0f;
  float column = acos(clamp(cosine, -1.0f, 1.0f)) / 3.14159265f * 39.0f;
  float left = min(floor(column), 38.0f);
  float below = min(floor(row), half_rows - 2.0f);
  ivec2 place = ivec2(int(left), int(first + below));
  float across = column - left;
  vec3 near = mix(sky_view_texel(layer, place), sky_view_texel(layer, place + ivec2(1, 0)), across);
  vec3 far =
      mix(sky_view_texel(layer, place + ivec2(0, 1)), sky_view_texel(layer, place + ivec2(1, 1)), across);
  return mix(near, far, row - below);
}

// Henyey and Greenstein 1941, per steradian; the asymmetry of air.h.
GLSL_FUNCTION float sky_haze_phase(float cosine) {
  float g = 0.76f;
  float base = 1.0f + g * g - 2.0f * g * cosine;
  return 0.07957747f * (1.0f - g * g) / (base * sqrt(base));
}

// Without the sun's disc.
GLSL_FUNCTION vec3 sky_view_radiance(vec3 direction, vec3 to_sun) {
  float cosine = clamp(dot(direction, to_sun), -1.0f, 1.0f);
  return sky_view_lookup(0, direction, to_sun) +
         sky_haze_phase(cosine) * sky_view_lookup(1, direction, to_sun);
}

// How bright the disc is there, relative to its mean, which is 1; 0 beside it. Darker toward the limb
// (Hestroffer and Magnan 1998, at 550 nm: (1 - r^2)^(0.5 * 0.52)).
GLSL_FUNCTION float sun_disc(vec3 direction, vec3 to_sun) {
  vec3 chord = direction - to_sun;
  float r2 = dot(chord, chord) / (0.004653f * 0.004653f);
  return r2 < 1.0f ? 1.26f * pow(1.0f - r2, 0.26f) : 0.0f;
}
