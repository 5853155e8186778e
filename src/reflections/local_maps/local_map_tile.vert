// A local map's rectangle of the picture of all maps, one an instance.
layout(location = 0) in vec4 rectangle;  // south-west corner and size, in texels of the finest level

#include "reflections/local_maps/picture_block.glsl"

out vec2 picture_uv;

void main() {
  vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1));
  picture_uv = (rectangle.xy + corner * rectangle.zw) / picture_size;
  gl_Position = vec4(picture_uv * 2.0f - 1.0f, 0.0f, 1.0f);
}
