// The surface of a grown plant's leaves.
#include "life/vegetation/leaf_surface.glsl"

flat in vec4 leaf_material;
in vec4 leaf_colour;

Surface surface_at(SeenPoint seen, inout float sun, out float alpha) {
  alpha = 1.0f;
#ifdef IS_POINT
  bool is_back = leaf_material.w > 0.5f;
  float shade = 1.0f;
#else
  bool is_back = dot(seen.normal, vertex_normal) < 0.0f;
  vec2 step_x = dFdx(uv), step_y = dFdy(uv);
  float shade = vein_shade(uv, leaf_material.x, 0.5f * (length(step_x) + length(step_y)));
#endif
  return leaf_surface(seen.normal, shade * leaf_side_colour(leaf_colour.rgb, is_back), leaf_material.y,
                      leaf_material.z, leaf_colour.a);
}
