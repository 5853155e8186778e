// A line of ink along an edge: a strip of four vertices that is a few pixels wide, before the surfaces that
// meet there. Edges that are not always drawn are outlines: one of their faces looks to the eye, the other
// away.
#include "graphics/render/frame.glsl"

layout(location = 0) in vec3 edge_from;
layout(location = 1) in vec3 edge_to;
layout(location = 2) in vec4 edge_normal;  // w: below 0 where the edge is always drawn
layout(location = 3) in vec4 edge_other_normal;
layout(location = 4) in vec4 world_from_mesh_row0;  // rows and eye: one for all edges of a draw
layout(location = 5) in vec4 world_from_mesh_row1;
layout(location = 6) in vec4 world_from_mesh_row2;
layout(location = 7) in vec4 eye_in_mesh;  // w: share of ink of edges that are no outline
layout(location = 8) in vec4 line_ink;     // x: share of ink of outlines; y: of the whole drawing
flat out float ink;

vec4 clip_of(vec3 mesh_position) {
  vec4 p = vec4(mesh_position, 1.0f);
  return clip_from_world *
         vec4(dot(world_from_mesh_row0, p), dot(world_from_mesh_row1, p), dot(world_from_mesh_row2, p), 1.0f);
}

void main() {
  const float nearest = 0.05f;   // of the eye's depth, for lines that go past it
  const float before = 1.0025f;  // depth, which is reversed: so much nearer than the surface
  const float outline_px = 1.7f, crease_px = 1.05f;  // in a picture 720 pixels high
  vec3 to_eye = eye_in_mesh.xyz - edge_from;
  float side = dot(edge_normal.xyz, to_eye), other_side = dot(edge_other_normal.xyz, to_eye);
  bool has_one_face = edge_normal.xyz == edge_other_normal.xyz;
  bool is_outline = has_one_face || side * other_side <= 0.0f;
  float share = is_outline ? line_ink.x : edge_normal.w < 0.0f ? eye_in_mesh.w : 0.0f;
  bool is_behind_surface = !is_outline && side < 0.0f && other_side < 0.0f;

  vec4 a = clip_of(edge_from), b = clip_of(edge_to);
  gl_Position = vec4(2.0f, 2.0f, 2.0f, 1.0f);  // off the screen
  ink = 0.0f;
  if (share <= 0.0f || is_behind_surface || max(a.w, b.w) < nearest) return;
  if (a.w < nearest) a = mix(a, b, (nearest - a.w) / (b.w - a.w));
  if (b.w < nearest) b = mix(b, a, (nearest - b.w) / (a.w - b.w));
  vec2 half_size = 0.5f * frame_size.xy;
  vec2 along = half_size * (b.xy / b.w - a.xy / a.w);
  float length_px = length(along);
  along = length_px > 1e-4f ? along / length_px : vec2(1.0f, 0.0f);
  float width_px = (is_outline ? outline_px : crease_px) * max(frame_size.y / 720.0f, 0.75f);
  bool is_end = (gl_VertexID & 1) != 0;
  vec4 end = is_end ? b : a;
  vec2 shift_px =
      0.5f * width_px *
      ((is_end ? along : -along) + ((gl_VertexID & 2) != 0 ? 1.0f : -1.0f) * vec2(-along.y, along.x));
  end.xy += shift_px / half_size * end.w;
  end.z *= before;
  gl_Position = end;
  // Far lines are thinner than a pen draws: they have less ink.
  float distance_m = min(a.w, b.w);
  ink = line_ink.y * share * mix(1.0f, 0.45f, clamp((distance_m - 30.0f) / 300.0f, 0.0f, 1.0f));
}
