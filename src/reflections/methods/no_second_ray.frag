// Drawn at the far plane over what has a depth in the layer of second rays: pixels without such a ray lose
// it.
uniform highp sampler2DArray ray_directions;

void main() {
  if (texelFetch(ray_directions, ivec3(ivec2(gl_FragCoord.xy), 1), 0).w != 0.0f) discard;
}
