// A leaf as a surface of graphics/shading/surface.glsl, for shaders and the ray tracer. `at`: the place on
// the leaf in leaf lengths, x across from the midrib, y along; `pixel`: a pixel's width there. Midrib and
// side veins are lighter than the blade, and fade where they are narrower than a pixel; so does what they
// take from the blade: the mean colour is that of a point.
GLSL_FUNCTION float vein_shade(vec2 at, float veins, float pixel) {
  if (veins <= 0.0f) return 1.0f;
  float across = abs(at.x);
  float midrib = 1.0f - smoothstep(0.006f + 0.5f * pixel, 0.02f + pixel, across);
  float place = fract(veins * (at.y - 0.75f * across));
  float side = 1.0f - smoothstep(0.04f, 0.16f + 2.0f * pixel * veins, abs(place - 0.5f));
  float seen = 1.0f - smoothstep(0.03f, 0.09f, pixel);
  return 1.0f + seen * (0.45f * midrib + 0.18f * side - 0.07f);
}

// The paler underside of a leaf.
GLSL_FUNCTION vec3 leaf_side_colour(vec3 colour, bool is_back) {
  return is_back ? mix(colour, vec3(0.16f, 0.2f, 0.12f), 0.3f) : colour;
}

GLSL_FUNCTION Surface leaf_surface(vec3 normal, vec3 colour, float translucency, float roughness) {
  Surface s;
  s.normal = normal;
  s.base_colour = colour;
  s.metallic = 0.0f;
  s.roughness = roughness;
  s.clear_coat = 0.0f;
  s.clear_coat_roughness = 0.03f;
  s.translucency = translucency;
  s.occlusion = 1.0f;  // what hides the sky is in the light of corners
  s.emission = vec3(0.0f);
  return s;
}

const float bark_roughness = 0.9f;

// `texel`: of the bark's picture, relative to the kind's colour, which is 0.5.
GLSL_FUNCTION Surface bark_surface(vec3 normal, vec3 texel, vec3 colour) {
  return leaf_surface(normal, min(2.0f * texel * colour, vec3(0.9f)), 0.0f, bark_roughness);
}
