// The surface of a grown plant's wood: bark around it.
#include "life/vegetation/leaf_surface.glsl"

uniform sampler2D bark_texture;  // relative to the kind's colour, which is 0.5

flat in vec3 bark_colour;
in float wood_openness;

Surface surface_at(SeenPoint seen, inout float sun, out float alpha) {
  alpha = 1.0f;
#ifdef IS_LINE
  vec3 bark = textureLod(bark_texture, uv, 8.0f).rgb;
#else
  vec3 bark = texture(bark_texture, uv).rgb;
#endif
  return leaf_surface(seen.normal, min(2.0f * bark * bark_colour, vec3(0.9f)), 0.0f, 0.9f, wood_openness);
}
