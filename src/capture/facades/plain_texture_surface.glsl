// The baseline of the bench `facades`: one texture, which is shown without light (IS_RECORDED).
uniform sampler2D plain_texture;  // linear light

Surface surface_at(SeenPoint seen, inout float sun, out float alpha) {
  alpha = 1.0f;
  Surface s;
  s.normal = seen.normal;
  s.base_colour = vec3(0.0f);
  s.metallic = 1.0f;
  s.roughness = 1.0f;
  s.clear_coat = 0.0f;
  s.clear_coat_roughness = 0.03f;
  s.translucency = 0.0f;
  s.occlusion = 1.0f;
  s.emission = texture(plain_texture, uv).rgb;
  return s;
}
