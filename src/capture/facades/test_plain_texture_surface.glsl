// The baseline of the bench `facades`: one texture, which is shown without light (IS_RECORDED).
uniform sampler2D plain_texture;  // linear light

Surface surface_at(SeenPoint seen, inout float sun, out float alpha) {
  alpha = 1.0f;
  return shining_surface(seen.normal, texture(plain_texture, uv).rgb);
}
