// How much of the sky a place sees: ambient light is occluded near walls and in narrow streets. A grid of
// cells over the fixed scene (shading/sky_visibility.h) holds, for each, the visibility of the sphere of
// directions in its first two bands: xyz the part that follows the direction, stored as 0.5 + b, and w the
// mean.

struct SkyVisibilityGrid {
  vec3 origin;  // corner of least coordinates, in the world
  vec3 size_m;
  float lift_m;  // a surface looks up the air before it, not the wall behind it
};

// Texture coordinates of the cell before a surface.
GLSL_FUNCTION vec3 sky_visibility_coordinates(SkyVisibilityGrid grid, vec3 position, vec3 geometric_normal) {
  return (position + grid.lift_m * geometric_normal - grid.origin) / grid.size_m;
}

// With V the visibility, the irradiance of a uniform sky on a surface is (1/4) integral(V) + (1/2) normal .
// integral(V direction) (Ramamoorthi and Hanrahan 2001); divided by that of an open sphere this is a + b .
// normal.
GLSL_FUNCTION float sky_share_of_normal(vec4 cell, vec3 normal) {
  vec3 b = vec3(cell.x, cell.y, cell.z) - vec3(0.5f);
  return clamp(cell.w + dot(b, normal), 0.0f, 1.0f);
}

// The visibility in one direction, for glossy reflections: bands weigh 1 and 3 in V, where they weigh 1 and 2
// above.
GLSL_FUNCTION float sky_share_of_direction(vec4 cell, vec3 direction) {
  vec3 b = vec3(cell.x, cell.y, cell.z) - vec3(0.5f);
  return clamp(cell.w + 1.5f * dot(b, direction), 0.0f, 1.0f);
}
