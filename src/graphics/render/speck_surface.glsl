// Points and lines of a few pixels have no surface of their own: their vertices know what they send out
// (leaf_light.glsl).
Surface surface_at(SeenPoint seen, inout float sun, out float alpha) {
  alpha = 1.0f;
  return shining_surface(seen.normal, vec3(0.0f));
}
