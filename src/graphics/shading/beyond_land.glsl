// What is seen behind the land of a scene. After sky.glsl.

// The sky above the horizon; below it the ground of the sky's picture, through the haze of at least as far as
// cameras see, and ever farther toward the horizon. `up`: z of the unit direction.
GLSL_FUNCTION vec3 beyond_land(vec3 sky, float up, float haze_per_m, vec3 haze_radiance) {
  const float land_m = 4000.0f, slope_of_its_edge = 0.025f;  // as from 100 m above it
  if (up >= 0.0f) return sky;
  return through_haze(sky, land_m * max(slope_of_its_edge / max(-up, 1e-6f), 1.0f), haze_per_m,
                      haze_radiance);
}
