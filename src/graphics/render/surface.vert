#include SURFACE_VERTEX "graphics/render/surface_vertex.glsl"

invariant gl_Position;  // as in depth.vert

void main() {
  surface_vertex();
  gl_Position = clip_from_world * vec4(position, 1.0f);
}
