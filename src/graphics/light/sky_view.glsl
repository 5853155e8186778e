// The clear sky as a picture of directions: sunlight scattered by the atmosphere (graphics/light/sky_view.h
// fills the table), and the glare of the haze about the sun. Colours are CIE XYZ.
//
// Includers define sky_view_texel(int layer, ivec2 place): the table, 2 layers (what is scattered; haze that
// scattered once, without its phase function) of the columns and rows of sky_view_layout.glsl.

// Elevations lie close at the horizon (Hillaire 2020): row 0 is level, the last one vertical.
GLSL_FUNCTION vec3 sky_view_lookup(int layer, vec3 direction, vec3 to_sun) {
  float half_rows = float(sky_view_rows / 2), last_column = float(sky_view_columns - 1);
  float elevation = asin(clamp(direction.z, -1.0f, 1.0f));
  float row = sqrt(abs(elevation) / 1.57079633f) * (half_rows - 1.0f);
  float first = direction.z < 0.0f ? half_rows : 0.0f;
  float level = length(vec2(direction.x, direction.y)) * length(vec2(to_sun.x, to_sun.y));
  float cosine = level > 1e-9f ? (direction.x * to_sun.x + direction.y * to_sun.y) / level : 1.0f;
  float column = acos(clamp(cosine, -1.0f, 1.0f)) / 3.14159265f * last_column;
  float left = min(floor(column), last_column - 1.0f);
  float below = min(floor(row), half_rows - 2.0f);
  ivec2 place = ivec2(int(left), int(first + below));
  float across = column - left;
  vec3 near = mix(sky_view_texel(layer, place), sky_view_texel(layer, place + ivec2(1, 0)), across);
  vec3 far =
      mix(sky_view_texel(layer, place + ivec2(0, 1)), sky_view_texel(layer, place + ivec2(1, 1)), across);
  return mix(near, far, row - below);
}

// Without the sun's disc.
GLSL_FUNCTION vec3 sky_view_radiance(vec3 direction, vec3 to_sun) {
  float cosine = clamp(dot(direction, to_sun), -1.0f, 1.0f);
  return sky_view_lookup(0, direction, to_sun) + haze_phase(cosine) * sky_view_lookup(1, direction, to_sun);
}
