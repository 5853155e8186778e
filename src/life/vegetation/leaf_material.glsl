// The surface of a grown plant's leaves.
#include "life/vegetation/leaf_surface.glsl"

flat in vec3 leaf_material;  // veins, translucency, roughness
in vec3 leaf_colour;

Surface surface_at(SeenPoint seen, inout float sun, out float alpha) {
  alpha = 1.0f;
  bool is_back = dot(seen.normal, vertex_normal) < 0.0f;
  vec2 step_x = dFdx(uv), step_y = dFdy(uv);
  float shade = vein_shade(uv, leaf_material.x, 0.5f * (length(step_x) + length(step_y)));
  return leaf_surface(seen.normal, shade * leaf_side_colour(leaf_colour, is_back), leaf_material.y,
                      leaf_material.z);
}
