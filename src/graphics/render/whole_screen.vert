// One triangle that covers the screen.
uniform float screen_depth;  // of what is drawn, in clip space

out vec2 screen_uv;

void main() {
  screen_uv = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
  gl_Position = vec4(screen_uv * 2.0f - 1.0f, screen_depth, 1.0f);
}
