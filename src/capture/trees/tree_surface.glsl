// Leaves and twigs of a captured tree: the textures of the two closest photographs, and light that comes from
// everywhere (003_d5b01da2d2f805f6, section 4.6).
#include "capture/trees/billboard.glsl"
#include "capture/trees/foliage.glsl"

uniform sampler2DArray tree_texels;  // TreeAtlas

flat in vec4 slants;
flat in vec4 base_of_cell;
flat in uvec2 tiles;
flat in float second_share;
flat in float albedo_factor;

// Linear, premultiplied.
vec4 tile_colour(uint tile) {
  if (tile == 0xFFFFFFFFu) return vec4(base_of_cell.rgb * base_of_cell.a, base_of_cell.a);
  vec2 corner = 4.0f * vec2(float(tile & 511u), float(tile >> 9 & 511u));
  float side = 4.0f * float(tile >> 26);
  vec2 at = corner + clamp(billboard_uv(uv) * side, vec2(0.5f), vec2(side - 0.5f));
  return textureLod(tree_texels, vec3(at / 2048.0f, float(tile >> 18 & 255u)), 0.0f);
}

Surface surface_at(SeenPoint seen, inout float sun, out float alpha) {
  if (silhouette_reach(uv, slants) > 1.0f) discard;
  vec4 colour = tile_colour(tiles.x);
  if (second_share > 0.0f) colour = mix(colour, tile_colour(tiles.y), second_share);
  if (colour.a < 1.0f / 510.0f) discard;
  alpha = colour.a;
#ifdef HAS_HOLES
  alpha = alpha > opacity_threshold(position) ? 1.0f : 0.0f;
#endif
  return foliage_surface(albedo_factor * colour.rgb / colour.a, to_sun_at(position), seen.to_viewer);
}
