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

/// How much a face's depth (z over w, which is affine on the screen) changes over `shift`, of the screen's
/// half size, from an edge between two of its points; 0 where the face is seen from its edge.
float change_of_depth(vec4 a, vec4 b, vec4 inside, vec2 shift) {
  vec3 p = a.xyz / a.w, u = b.xyz / b.w - p, v = inside.xyz / inside.w - p;
  float area = u.x * v.y - u.y * v.x;
  if (abs(area) < 1e-9f || inside.w <= 0.0f) return 0.0f;
  vec2 gradient = vec2(u.z * v.y - u.y * v.z, u.x * v.z - u.z * v.x) / area;
  return dot(gradient, shift);
}

void main() {
  const float nearest = 0.05f;  // of the eye's depth, for lines that go past it
  // Depth is reversed. A line lies before the faces of its edge over all of its width and hardly more, or it
  // would show through what it goes into.
  const float before = 1.0001f, max_before = 1.0025f;
  const float over_end = 0.6f;  // of half the width: lines that meet leave no gap, and none sticks out
  const float outline_px = 1.4f, crease_px = 1.05f;  // in a picture 720 pixels high
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
  vec2 shift_px = 0.5f * width_px *
                  (over_end * (is_end ? along : -along) +
                   ((gl_VertexID & 2) != 0 ? 1.0f : -1.0f) * vec2(-along.y, along.x));
  vec2 shift = shift_px / half_size;
  vec3 along_edge = edge_to - edge_from;
  vec3 reach = 0.01f * length(to_eye) / max(length(along_edge), 1e-9f) * along_edge;  // metres
  vec4 inside = clip_of(edge_from + cross(edge_normal.xyz, reach));
  vec4 other_inside = clip_of(edge_from + cross(edge_other_normal.xyz, reach));
  float nearer = max(change_of_depth(a, b, inside, shift), change_of_depth(a, b, other_inside, shift));
  float depth = end.z / end.w;
  end.xy += shift * end.w;
  end.z = end.w * clamp(depth * before + max(nearer, 0.0f), depth * before, depth * max_before);
  gl_Position = end;
  // Far lines are thinner than a pen draws: they have less ink.
  float distance_m = min(a.w, b.w);
  ink = line_ink.y * share * mix(1.0f, 0.45f, clamp((distance_m - 30.0f) / 300.0f, 0.0f, 1.0f));
}
