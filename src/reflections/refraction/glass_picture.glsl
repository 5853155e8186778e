// What solid glass lets through, where it is followed.
uniform sampler2D glass_picture;  // of the main view's size: what glass lets through; coverage in alpha
uniform float glass_share;        // 0: it shows what another glass lets through there

vec3 seen_through_glass(vec3 straight_radiance) {
  vec4 seen = texelFetch(glass_picture, ivec2(gl_FragCoord.xy), 0);
  if (glass_share * seen.a > 0.0f) return seen.rgb / seen.a;
  return straight_radiance;
}
