// A rectangle in the room, as an eye sees it.
uniform mat4 clip_from_room;
uniform vec3 lower_left;
uniform vec3 right;
uniform vec3 up;

out vec2 panel_share;

void main() {
  panel_share = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1));
  gl_Position = clip_from_room * vec4(lower_left + panel_share.x * right + panel_share.y * up, 1.0f);
}
