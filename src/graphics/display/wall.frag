// A pixel of a projector: the pictures of its eyes as one, and its share of the light where projectors
// overlap.
#include "graphics/shading/srgb.glsl"

uniform sampler2D left_picture;  // or that of both eyes
uniform sampler2D right_picture;
uniform mat4 left_from_room;
uniform mat4 right_from_room;
uniform bool is_curved;
uniform int pattern;      // 0: the left picture, 1: rows, 2: a chessboard, 3: red and cyan
uniform float height_px;  // of the wall
uniform vec4 overlap;     // left, right, below, above: shares of the wall
uniform float gamma;      // of the projector; 0: sRGB
in vec3 room_point;
in vec2 wall_share;
out vec4 colour;

vec3 light_of(vec3 value) { return gamma > 0.0f ? pow(value, vec3(gamma)) : linear_of_srgb(value); }

vec3 value_of(vec3 light) {
  vec3 shown = clamp(light, vec3(0.0f), vec3(1.0f));
  return gamma > 0.0f ? pow(shown, vec3(1.0f / gamma)) : srgb_of_linear(shown);
}

vec2 place_in(mat4 clip_from_room) {
  vec4 clip = clip_from_room * vec4(room_point, 1.0f);
  return is_curved ? 0.5f + 0.5f * clip.xy / clip.w : wall_share;
}

// Two ramps that meet add up to one (P. Bourke, Edge blending using commodity projectors, 2004).
float ramp(float from_edge, float width) {
  if (width <= 0.0f) return 1.0f;
  float t = clamp(from_edge / width, 0.0f, 1.0f);
  return t < 0.5f ? 2.0f * t * t : 1.0f - 2.0f * (1.0f - t) * (1.0f - t);
}

// Eight steps between two values of 8 bits, by a pattern that is even along rows: else dark overlaps show the
// rounding of both projectors.
float dither(uvec2 pixel) {
  uint k = (pixel.x + 3u * pixel.y) & 7u;
  k = (k & 1u) << 2 | (k & 2u) | k >> 2;
  return ((float(k) + 0.5f) / 8.0f - 0.5f) / 255.0f;
}

void main() {
  vec3 left = textureLod(left_picture, place_in(left_from_room), 0.0f).rgb;
  vec3 shown = left;
  if (pattern > 0) {
    vec3 right = textureLod(right_picture, place_in(right_from_room), 0.0f).rgb;
    vec2 pixel = floor(vec2(gl_FragCoord.x, height_px - gl_FragCoord.y));
    if (pattern == 1) shown = mod(pixel.y, 2.0f) < 0.5f ? left : right;
    if (pattern == 2) shown = mod(pixel.x + pixel.y, 2.0f) < 0.5f ? left : right;
    // Least squares for the primaries of screens and the filters of red-cyan glasses (E. Dubois, A projection
    // method to generate anaglyph stereo images, 2001).
    if (pattern == 3)
      shown = value_of(mat3(0.456f, -0.040f, -0.015f, 0.500f, -0.038f, -0.021f, 0.176f, -0.016f, -0.005f) *
                           light_of(left) +
                       mat3(-0.043f, 0.378f, -0.072f, -0.088f, 0.734f, -0.113f, -0.002f, -0.018f, 1.226f) *
                           light_of(right));
  }
  float share = ramp(wall_share.x, overlap.x) * ramp(1.0f - wall_share.x, overlap.y) *
                ramp(wall_share.y, overlap.z) * ramp(1.0f - wall_share.y, overlap.w);
  if (share < 1.0f) shown = value_of(share * light_of(shown)) + dither(uvec2(gl_FragCoord.xy));
  colour = vec4(shown, 1.0f);
}
