// The surface of a grown plant's wood: bark around it.
#include "life/vegetation/leaf_surface.glsl"

uniform sampler2D bark_texture;

flat in vec3 bark_colour;

Surface surface_at(SeenPoint seen, inout float sun, out float alpha) {
  alpha = 1.0f;
  return bark_surface(seen.normal, texture(bark_texture, uv).rgb, bark_colour);
}
