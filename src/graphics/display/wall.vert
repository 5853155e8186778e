// A wall's triangles in the projector's picture.
layout(location = 0) in vec3 surface_pixel;  // homogeneous
layout(location = 1) in vec3 surface_point;
layout(location = 2) in vec2 surface_share;

out vec3 room_point;
out vec2 wall_share;

void main() {
  gl_Position = vec4(2.0f * surface_pixel.xy - surface_pixel.z, 0.0f, surface_pixel.z);
  room_point = surface_point;
  wall_share = surface_share;
}
