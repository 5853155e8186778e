// How unlike the mirror rays of a picture are. Needs shading/octahedral.glsl.
uniform highp sampler2DArray ray_starts;      // w: roughness
uniform highp sampler2DArray ray_directions;  // w: the object's index and 1; 0: no ray

const float alike_turn = 0.3f;        // difference of unit directions
const float alike_footprints = 3.0f;  // between the starts of two rays

// How unlike a pixel's ray is that of the surface at `at`, which mirrors `direction`: above 1 it belongs to
// another. `pixel.z` is the layer, `tag` the surface's object and 1.
float ray_difference(ivec3 pixel, int tag, vec3 at, vec3 direction, float footprint_m) {
  vec4 ray = texelFetch(ray_directions, pixel, 0);
  if (int(ray.w) != tag) return 1e9f;
  vec3 turn = (octahedral_direction(ray.xy) - direction) / alike_turn;
  vec3 away = (texelFetch(ray_starts, pixel, 0).xyz - at) / (alike_footprints * footprint_m);
  return dot(turn, turn) + dot(away, away);
}

// The pixel to the west, east, south or north; at the picture's border the pixel itself.
ivec2 pixel_beside(int side) {
  ivec2 step = side < 2 ? ivec2(2 * side - 1, 0) : ivec2(0, 2 * side - 5);
  return clamp(ivec2(gl_FragCoord.xy) + step, ivec2(0), textureSize(ray_directions, 0).xy - ivec2(1));
}
