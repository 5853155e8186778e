// Of a view-dependent object: a corner, and which one of which triangle it is.
#include "graphics/render/frame.glsl"
#include "graphics/render/surface_outputs.glsl"
#include "capture/view_dependent_objects/object_block.glsl"

layout(location = 0) in vec3 object_corner;
layout(location = 1) in vec3 object_normal;

out vec3 position_in_object;
out vec3 corner_weights;
flat out int triangle_of_object;

void surface_vertex() {
  position = (world_from_object * vec4(object_corner, 1.0f)).xyz;
  vertex_normal = (world_from_object * vec4(object_normal, 0.0f)).xyz;
  uv = vec2(0.0f);
  object_of_surface = thing;
  position_in_object = object_corner;
  triangle_of_object = gl_VertexID / 3;
  int corner = gl_VertexID - 3 * triangle_of_object;
  corner_weights = vec3(corner == 0 ? 1.0f : 0.0f, corner == 1 ? 1.0f : 0.0f, corner == 2 ? 1.0f : 0.0f);
}
