// Leaves and twigs of a captured tree: the textures of the two closest photographs
// (003_d5b01da2d2f805f6, section 4.6), in the light that the billboard's corners have (leaf_light.glsl).
#include "capture/trees/billboard.glsl"
#include "capture/trees/foliage.glsl"
#ifdef HAS_DETAIL
#include "capture/trees/leaf_detail.glsl"
#endif

uniform sampler2DArray tree_texels;  // TreeAtlas

flat in vec4 slants;
flat in vec4 base_of_cell;
flat in uvec2 tiles;
flat in vec4 scales;
flat in vec3 share_level_factor;
#ifdef HAS_DETAIL
uniform mediump sampler2DArray detail_tiles;  // DetailTiles
flat in vec4 place_in_detail;                 // of the billboard's middle in tiles; tiles per half billboard
flat in float detail_layer;
#endif
#if !defined(WRITES_DEPTH) && !defined(WRITES_OBJECT)
in vec3 highlight_of_leaves;
in vec3 radiance_per_albedo;
#endif

// Linear, premultiplied.
vec4 tile_colour(uint tile, vec2 scale) {
  if (tile == 0xFFFFFFFFu) return vec4(base_of_cell.rgb * base_of_cell.a, base_of_cell.a);
  vec2 corner = 4.0f * vec2(float(tile & 511u), float(tile >> 9 & 511u));
  float side = 4.0f * float(tile >> 26), level = share_level_factor.y;
  float border = 0.5f * exp2(level);  // half a texel of the mip level
  vec2 at = corner + clamp(billboard_uv(uv * scale) * side, vec2(border), vec2(side - border));
  return textureLod(tree_texels, vec3(at / 2048.0f, float(tile >> 18 & 255u)), level);
}

Surface surface_at(SeenPoint seen, inout float sun, out float alpha) {
#ifdef HAS_DETAIL
  // Before anything is discarded, for the neighbours that say how large a pixel is.
  vec2 place = place_in_detail.xy + place_in_detail.zw * uv;
  vec2 detail = texture(detail_tiles, vec3(place, detail_layer)).xy;
  vec2 second = texture(detail_tiles, vec3(detail_octave * place + second_detail_offset, detail_layer)).xy;
  float tiles_per_pixel = max(length(dFdx(place)), length(dFdy(place)));
  float pixel_in_texels = float(textureSize(detail_tiles, 0).x) * tiles_per_pixel;
  float closer = detail_texels_per_photographed_pixel / max(pixel_in_texels, 1e-6f);
#endif
  if (silhouette_reach(uv, slants) > 1.0f) discard;
  vec4 colour = tile_colour(tiles.x, scales.xy);
  float second_share = share_level_factor.x;
  if (second_share > 0.0f) colour = mix(colour, tile_colour(tiles.y, scales.zw), second_share);
#ifdef HAS_DETAIL
  colour = with_detail(colour, detail_share(closer) * detail);
  colour = with_detail(colour, detail_share(closer / detail_octave) * second);
#endif
  if (colour.a < 1.0f / 510.0f) discard;
  alpha = colour.a;
#ifdef HAS_HOLES
  alpha = alpha > opacity_threshold(position) ? 1.0f : 0.0f;
#endif
#if !defined(WRITES_DEPTH) && !defined(WRITES_OBJECT)
  vec3 albedo = share_level_factor.z * colour.rgb / colour.a;
  return shining_surface(seen.normal, highlight_of_leaves + without_highlight(albedo) * radiance_per_albedo);
#else
  return shining_surface(seen.normal, vec3(0.0f));
#endif
}
