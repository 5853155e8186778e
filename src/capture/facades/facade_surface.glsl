// Of a captured facade: light that photographs have recorded (IS_RECORDED).
#include "graphics/shading/tone_curve.glsl"
#include "graphics/shading/view_blend.glsl"
#include "graphics/shading/recorded_light.glsl"
#include "capture/facades/facade_block.glsl"
#include "capture/facades/facade_photo.glsl"

uniform highp sampler2D facade_photos;  // a row of 7 texels per photograph
uniform highp usampler2D facade_layers, facade_candidates, facade_tiles,
    facade_depths;                          // lists in rows of 1024
uniform highp sampler2DArray facade_atlas;  // pages of 16 x 16 slots

#ifdef RECEIVES_INSERTED
flat in float lit_luminance;  // of the surface in the sun, exposed; 0: not known
#endif
// IS_CHOSEN: photographs and their weights are chosen for the triangle (chosen_triangle.h).
#ifdef IS_CHOSEN
in vec4 at_of_chosen, of_first, of_second;  // ChosenCorner; w: pixel_sizes of ChosenTriangle
in vec3 rest_of_chosen;
flat in ivec4 stored_of_chosen;  // as ChosenTriangle::tiles, with slots in place of tiles; z < 0: no second
#else
in vec3 position_in_facade;
in vec3 fallback_colour;
flat in uvec2 candidates;
#endif

FacadePhoto facade_photo(int photo) {
  return FacadePhoto(
      texelFetch(facade_photos, ivec2(0, photo), 0), texelFetch(facade_photos, ivec2(1, photo), 0),
      texelFetch(facade_photos, ivec2(2, photo), 0), texelFetch(facade_photos, ivec2(3, photo), 0),
      texelFetch(facade_photos, ivec2(4, photo), 0), texelFetch(facade_photos, ivec2(5, photo), 0),
      texelFetch(facade_photos, ivec2(6, photo), 0));
}
ivec2 place_in_list(int index) { return ivec2(index & 1023, index >> 10); }
uvec4 facade_layer(int layer) { return texelFetch(facade_layers, place_in_list(layer), 0); }
int facade_candidate(int index) { return int(texelFetch(facade_candidates, place_in_list(index), 0).x); }
uvec4 facade_tile(int tile) {
  uint entry = texelFetch(facade_tiles, place_in_list(tile), 0).x;
  return uvec4(entry & 3u, entry >> 2u, 0u, 0u);
}
float facade_depth(int index) {
  return float(texelFetch(facade_depths, place_in_list(index), 0).x) / 2048.0f - 16.0f;
}
vec4 facade_texel(int slot, vec2 at, float level) {
  vec2 corner = 64.0f * vec2(float(slot & 15), float((slot >> 4) & 15));
  return textureLod(facade_atlas, vec3((corner + at) / 1024.0f, float(slot >> 8)), level);
}
#include "capture/facades/facade_lookup.glsl"

#ifdef IS_CHOSEN
vec4 shown_colour(SeenPoint seen) {
  ivec4 stored = stored_of_chosen;
  vec3 colour = rest_of_chosen;
  vec3 right = dFdx(position), up = dFdy(position);
  float pixel_size = 0.5f * log2(max(min(dot(right, right), dot(up, up)), 1e-12f)) + facade_units_log2;
  // Loops of one round: renderers in software skip those without, and no branches.
  for (int i = 0; i < min(stored.x + 1, 1); ++i)
    colour += of_first.rgb * facade_stored(at_of_chosen.xy, stored.x, stored.y, pixel_size - of_first.w);
  for (int i = 0; i < min(stored.z + 1, 1); ++i)
    colour += of_second.rgb * facade_stored(at_of_chosen.zw, stored.z, stored.w, pixel_size - of_second.w);
  return vec4(colour, 1.0f);
}
#else
vec4 shown_colour(SeenPoint seen) {
  float pixel_m = min(length(dFdx(position_in_facade)), length(dFdy(position_in_facade)));
  vec3 to_eye = normalize((facade_from_world * vec4(seen.to_viewer, 0.0f)).xyz);
  return facade_colour(position_in_facade, to_eye, pixel_m, int(candidates.x), int(candidates.y),
                       fallback_colour);
}
#endif

Surface surface_at(SeenPoint seen, inout float sun, out float alpha) {
  vec4 colour = shown_colour(seen);
  alpha = colour.a;
  vec3 exposed = srgb_tone_unmapped(clamp(colour.rgb, vec3(0.0f), vec3(1.0f)));
#ifdef RECEIVES_INSERTED
  kept_in_shadow = kept_in_shadow_of(kept_of_shadows, lit_luminance, exposed);
#endif
  return shining_surface(seen.normal, radiance_of_exposed * exposed);
}
