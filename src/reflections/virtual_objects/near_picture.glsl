// What mirrors show of the objects that stand near, over what the method of reflection shows beyond.
uniform sampler2D
    near_picture;  // of the main view's size: what stands near, as its mirrors show it; coverage in alpha
uniform float near_share;  // 0: it shows what another mirror mirrors there, behind this one

// `mirrors`: 1 for surfaces that mirror as the scene's method says. The picture is sharp. A rough layer blurs
// it widely: it shows that much less of it.
vec3 with_near_objects(vec3 far_radiance, float roughness, float mirrors) {
  float sharp = near_share * mirrors * (1.0f - smoothstep(0.15f, 0.72f, roughness));
  vec4 seen = sharp * texelFetch(near_picture, ivec2(gl_FragCoord.xy), 0);
  return seen.rgb + (1.0f - seen.a) * far_radiance;
}
