// Light that surfaces reflect onto each other: irradiance in a grid of cells over a place, as its mean and
// the part that follows the normal (two bands of spherical harmonics convolved with the cosine, Ramamoorthi
// and Hanrahan 2001), with one colour per cell; and how bright that part of the sky is which a cell sees.

struct BouncedGrid {
  vec3 origin;  // corner of least coordinates, in the world
  vec3 size_m;
  float lift_m;  // a surface asks the air before it
  float layers;  // cells in z; 0: there is no bounced light
};

// Texture coordinates of the cell before a surface, z within the third of the texture that holds the lobes;
// colours lie a third above, and skies as much above these.
GLSL_FUNCTION vec3 bounced_coordinates(BouncedGrid grid, vec3 position, vec3 geometric_normal) {
  vec3 at = (position + grid.lift_m * geometric_normal - grid.origin) / grid.size_m;
  float margin = 0.5f / grid.layers;
  return vec3(at.x, at.y, clamp(at.z, margin, 1.0f - margin) / 3.0f);
}

struct BouncedCell {
  vec4 lobe;    // of irradiance: xyz the part that follows the normal, w the mean
  vec3 colour;  // luminance 1
  vec3 sky;     // mean radiance of the sky that is seen from here, over that of the whole sky
};

// Irradiance on a surface.
GLSL_FUNCTION vec3 bounced_irradiance(BouncedCell cell, vec3 normal) {
  return max(cell.lobe.w + dot(vec3(cell.lobe.x, cell.lobe.y, cell.lobe.z), normal), 0.0f) * cell.colour;
}

// Radiance that arrives from one direction, for glossy reflections: bands weigh 1 and 3 in it, where they
// weigh pi and 2 pi above.
GLSL_FUNCTION vec3 bounced_radiance(BouncedCell cell, vec3 direction) {
  float along = dot(vec3(cell.lobe.x, cell.lobe.y, cell.lobe.z), direction);
  return max(cell.lobe.w + 1.5f * along, 0.0f) / 3.14159265f * cell.colour;
}
