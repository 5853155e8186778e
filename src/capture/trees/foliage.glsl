// Foliage as a surface of graphics/shading/surface.glsl, for shaders and the ray tracer: leaves of all
// directions scatter light to all sides alike. `albedo` of what is lit.
//
// The normal lies halfway between the viewer and the sun (or what is opposite to it), where it is seen and
// lit at the same cosine of at least 0.7; divided by it the light does not depend on the view. There the
// surface's own highlight is nearly constant: it is taken off, for the photographs' colours hold one already.
// What is darker than that highlight is shown as bright as it.
const float leaf_highlight =
    0.0125f;  // 0.04 of Fresnel through GGX of roughness 1, of sun and sky, as albedo

GLSL_FUNCTION vec3 without_highlight(vec3 albedo) { return max(albedo - vec3(leaf_highlight), vec3(0.0f)); }

GLSL_FUNCTION Surface foliage_surface(vec3 albedo, vec3 to_sun, vec3 to_viewer) {
  float side = dot(to_sun, to_viewer) < 0.0f ? -1.0f : 1.0f;
  vec3 halfway = to_viewer + side * to_sun;
  Surface s;
  s.normal = halfway / length(halfway);
  float cosine = abs(dot(s.normal, to_sun));
  s.base_colour = without_highlight(albedo) / cosine;
  s.metallic = 0.0f;
  s.roughness = 1.0f;
  s.clear_coat = 0.0f;
  s.clear_coat_roughness = 0.03f;
  s.translucency = 1.0f;
  s.occlusion = 0.5f * cosine;  // what the two hemispheres bring together is the sky's mean
  s.emission = vec3(0.0f);
  return s;
}
