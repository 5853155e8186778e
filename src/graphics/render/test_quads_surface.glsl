// Of test_quads.h: a texture with holes, and light that depends on the viewer.
#include "graphics/render/test_quads_shared.glsl"

uniform sampler2D quad_texture;

Surface surface_at(SeenPoint seen, inout float sun, out float alpha) {
  vec4 texel = texelFetch(quad_texture, clamp(ivec2(floor(8.0f * uv)), 0, 7), 0);
  alpha = texel.a;
  Surface s;
  s.normal = seen.normal;
  s.base_colour = texel.rgb;
  s.metallic = 0.0f;
  s.roughness = 1.0f;
  s.clear_coat = 0.0f;
  s.clear_coat_roughness = 0.03f;
  s.translucency = 0.0f;
  s.occlusion = 1.0f;
  s.emission = emission_toward(seen.to_viewer);
  return s;
}
