#include "graphics/render/frame.glsl"
#include "graphics/render/object_flags.glsl"

layout(location = 0) in vec3 mesh_position;
layout(location = 2) in vec2 mesh_uv;
layout(location = 3) in vec4 world_from_mesh_row0;
layout(location = 4) in vec4 world_from_mesh_row1;
layout(location = 5) in vec4 world_from_mesh_row2;
layout(location = 6) in uint object;
layout(location = 10) in vec4 mesh_colour;

out vec2 uv;
out float colour_alpha;
flat out uint object_of_fragment;

invariant gl_Position;  // as in surface.vert, which draws over these depths

void main() {
  vec4 p = vec4(mesh_position, 1.0f);
  vec3 world = vec3(dot(world_from_mesh_row0, p), dot(world_from_mesh_row1, p), dot(world_from_mesh_row2, p));
  uv = mesh_uv;
  colour_alpha = mesh_colour.a;
  object_of_fragment = object & ~no_shadow_received;
  gl_Position = clip_from_world * vec4(world, 1.0f);
}
