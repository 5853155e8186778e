// Holes of leaves and railings in pictures without colour.
#include "graphics/render/material.glsl"

in vec2 uv;
in float colour_alpha;

void discard_holes() {
  if (material_texture_v.w < 0.5f) return;
  if (texture(base_colour_texture, texture_coordinates(uv)).a * material_base_colour.a * colour_alpha < 0.5f)
    discard;
}
