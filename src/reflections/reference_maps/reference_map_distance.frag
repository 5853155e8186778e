// One face of a cube map's depth, spread over its part of an octahedral layer as distances from the centre in
// metres.
#include "graphics/shading/octahedral.glsl"

uniform highp sampler2D face_depth;  // reversed: 1 at the near plane, 0 at the far one
uniform mat4 clip_from_direction;    // of the face, seen from its centre
uniform vec2 near_far;
uniform vec2 layer_size;  // texels per side, and of its border
in vec2 screen_uv;
out float distance_m;

void main() {
  vec3 direction = layer_direction(screen_uv, layer_size.x, layer_size.y);
  vec4 clip = clip_from_direction * vec4(direction, 1.0f);
  if (clip.w <= 0.0f || max(abs(clip.x), abs(clip.y)) > clip.w * 1.0001f) discard;
  vec2 size = vec2(textureSize(face_depth, 0));
  ivec2 texel = ivec2(clamp((0.5f * clip.xy / clip.w + 0.5f) * size, vec2(0.0f), size - 1.0f));
  float depth = texelFetch(face_depth, texel, 0).r;  // between two depths nothing is
  float ahead = near_far.x * near_far.y / (near_far.x + depth * (near_far.y - near_far.x));
  distance_m = ahead / clip.w;
}
