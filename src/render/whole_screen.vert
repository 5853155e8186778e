// One triangle that covers the screen, at the far plane.
out vec2 screen_uv;

void main() {
  screen_uv = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
  gl_Position = vec4(screen_uv * 2.0f - 1.0f, 1.0f, 1.0f);
}
