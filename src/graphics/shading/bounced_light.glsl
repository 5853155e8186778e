// Light that surfaces reflect onto each other: irradiance in a grid of cells over a place, as its mean and
// the part that follows the normal (two bands of spherical harmonics convolved with the cosine, Ramamoorthi
// and Hanrahan 2001), with one colour per cell.

struct BouncedGrid {
  vec3 origin;  // corner of least coordinates, in the world
  vec3 size_m;
  float lift_m;  // a surface asks the air before it
  float layers;  // cells in z; 0: there is no bounced light
};

// Texture coordinates of the cell before a surface, z within the half of the texture that holds the lobes;
// colours lie 0.5 above.
GLSL_FUNCTION vec3 bounced_coordinates(BouncedGrid grid, vec3 position, vec3 geometric_normal) {
  vec3 at = (position + grid.lift_m * geometric_normal - grid.origin) / grid.size_m;
  float margin = 0.5f / grid.layers;
  return vec3(at.x, at.y, 0.5f * clamp(at.z, margin, 1.0f - margin));
}

// Irradiance on a surface; `lobe`: xyz the part that follows the normal, w the mean; `colour` has luminance
// 1.
GLSL_FUNCTION vec3 bounced_irradiance(vec4 lobe, vec3 colour, vec3 normal) {
  return max(lobe.w + dot(vec3(lobe.x, lobe.y, lobe.z), normal), 0.0f) * colour;
}
