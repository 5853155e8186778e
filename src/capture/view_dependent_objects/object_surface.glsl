// Of a view-dependent object: light that its textures have recorded, and nothing else (IS_RECORDED).
#include "graphics/shading/tone_curve.glsl"
#include "graphics/shading/recorded_light.glsl"
#include "graphics/shading/view_blend.glsl"

#include "capture/view_dependent_objects/object_block.glsl"
#include "capture/view_dependent_objects/view_table_layout.glsl"
uniform highp sampler2D view_table;
uniform highp sampler2DArray view_pictures;

in vec3 position_in_object;
in vec3 corner_weights;
flat in int triangle_of_object;

vec4 view_entry(int index) {
  return texelFetch(view_table, ivec2(index & (view_table_px - 1), index / view_table_px), 0);
}
vec4 view_picture(int layer, vec2 uv, vec2 along_x, vec2 along_y) {
  return textureGrad(view_pictures, vec3(uv, float(layer)), along_x, along_y);
}
#include "capture/view_dependent_objects/view_lookup.glsl"

Surface surface_at(SeenPoint seen, inout float sun, out float alpha) {
  vec3 to_eye = normalize((object_from_world * vec4(seen.to_viewer, 0.0f)).xyz);
  vec4 colour =
      blended_colour(first_entry, view_count, triangle_of_object - first_triangle, pass_count,
                     position_in_object, to_eye, corner_weights, dFdx(corner_weights), dFdy(corner_weights));
  alpha = colour.a;
  vec3 exposed = tone_unmapped(colour.rgb);
  kept_in_shadow = kept_in_shadow_of(kept_of_shadows, lit_luminance, exposed);
  return shining_surface(seen.normal, radiance_of_exposed * exposed);
}
