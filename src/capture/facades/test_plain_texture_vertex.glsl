// The baseline of the bench `facades`: a mesh with one texture.
#include "graphics/render/frame.glsl"
#include "graphics/render/surface_outputs.glsl"

layout(location = 0) in vec3 plain_corner;
layout(location = 1) in vec3 plain_normal;
layout(location = 2) in vec2 plain_uv;

uniform int plain_thing;

void surface_vertex() {
  position = plain_corner;
  vertex_normal = plain_normal;
  uv = plain_uv;
  object_of_surface = plain_thing;
}
