// How a reference map is blurred for rough surfaces: as far as its mipmaps' border reaches by these, and
// beyond by small tiles, side by side in one layer a map, blurred beforehand with the lobe of a surface seen
// from the front (Karis 2013).

const float layer_rad = 3.545f;  // the sphere's area over the square's: a layer of one texel spans so much
const float min_gloss = 0.25f;   // roughness of the first tile; they are as far apart
const float gloss_tile_count = 4.0f;
const float gloss_side = 32.0f;  // texels
const float gloss_border = 1.0f;

// Texels of a layer of `resolution` that a sharp lobe covers: half of what it mirrors lies within twice
// alpha.
GLSL_FUNCTION float lobe_texels(float roughness, float resolution) {
  return 3.0f * roughness * roughness * resolution / layer_rad;
}

// Two tiles, and the share of the second.
GLSL_FUNCTION vec3 gloss_tiles(float roughness) {
  float at = clamp(roughness / min_gloss - 1.0f, 0.0f, gloss_tile_count - 1.0f);
  float first = min(floor(at), gloss_tile_count - 2.0f);
  return vec3(first, first + 1.0f, at - first);
}

GLSL_FUNCTION float gloss_of_tile(float tile) { return min_gloss * (tile + 1.0f); }

// Where in the row of tiles a place within one of them lies.
GLSL_FUNCTION vec2 gloss_uv(vec2 uv, float tile) { return vec2((uv.x + tile) / gloss_tile_count, uv.y); }
