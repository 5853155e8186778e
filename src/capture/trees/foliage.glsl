// Foliage as a surface of graphics/shading/surface.glsl, for shaders and the ray tracer: leaves of all
// directions scatter light to all sides alike, so the normal that light asks for is the direction of the sun,
// and both hemispheres light it.
GLSL_FUNCTION Surface foliage_surface(vec3 albedo, vec3 to_sun) {
  Surface s;
  s.normal = to_sun.z > 0.0f ? to_sun : vec3(0.0f, 0.0f, 1.0f);
  s.base_colour = albedo;
  s.metallic = 0.0f;
  s.roughness = 1.0f;
  s.clear_coat = 0.0f;
  s.clear_coat_roughness = 0.03f;
  s.translucency = 1.0f;
  s.occlusion = 0.5f;  // of the sky: what the two hemispheres bring together is its mean
  s.emission = vec3(0.0f);
  return s;
}
