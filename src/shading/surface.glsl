// What light does at a surface: Lambert and GGX (Walter 2007, Karis 2013) under a clear coat (glTF
// KHR_materials_clearcoat), translucent leaves. Shared by shaders and ray tracer.

struct Surface {
  vec3 normal;        // unit, on the viewer's side
  vec3 base_colour;   // linear
  float metallic;
  float roughness;    // perceptual, alpha = roughness^2
  float clear_coat;
  float clear_coat_roughness;
  float translucency;
  float occlusion;    // 1: open to the sky
  vec3 emission;
};

// Highlights of the sun are not allowed to get sharper than this: a mirror would show the sun's disc, of 0.5 degrees.
const float min_roughness = 0.05f;
const float pi = 3.14159265f;

GLSL_FUNCTION vec3 specular_f0(Surface s) { return mix(vec3(0.04f), s.base_colour, s.metallic); }

GLSL_FUNCTION float schlick_weight(float cosine) {
  float m = clamp(1.0f - cosine, 0.0f, 1.0f);
  return (m * m) * (m * m) * m;
}

GLSL_FUNCTION float fresnel_of_coat(Surface s, float n_dot_v) {
  return s.clear_coat * (0.04f + 0.96f * schlick_weight(n_dot_v));
}

GLSL_FUNCTION float ggx_alpha(float roughness) {
  return max(roughness, min_roughness) * max(roughness, min_roughness);
}

GLSL_FUNCTION float ggx_distribution(float alpha, float n_dot_h) {
  float a2 = alpha * alpha;
  float d = n_dot_h * n_dot_h * (a2 - 1.0f) + 1.0f;
  return a2 / (pi * d * d);
}

// GGX distribution times the Smith visibility term (Hammon's approximation).
GLSL_FUNCTION float ggx_specular(float roughness, float n_dot_l, float n_dot_v, float n_dot_h) {
  float alpha = ggx_alpha(roughness);
  float visibility = 0.5f / mix(2.0f * n_dot_l * n_dot_v, n_dot_l + n_dot_v, alpha);
  return ggx_distribution(alpha, n_dot_h) * visibility;
}

// Share of the radiance from the mirror direction that goes to the viewer, for the base layer: the split sum with
// Karis' polynomial for mobile (2014) in place of its table.
GLSL_FUNCTION vec3 base_reflectance(Surface s, float n_dot_v) {
  float r = s.roughness;
  float a = min((1.0f - r) * (1.0f - r), exp2(-9.28f * n_dot_v)) * (1.0f - r) + (0.0425f - 0.0275f * r);
  float scale = -1.04f * a + 1.04f - 0.572f * r;
  float bias = 1.04f * a - 0.04f + 0.022f * r;
  return specular_f0(s) * max(scale, 0.0f) + vec3(clamp(bias, 0.0f, 1.0f));
}

// Share of the light from `to_light` that goes to the viewer: BRDF times cosine. What a layer reflects does not reach
// the ones below, on the way in or out, whichever is lower: then no surface gives more light than it gets. The highlights
// of base and coat count by their weights: 1, or 0 where a path follows their mirror ray instead.
GLSL_FUNCTION vec3 scattered_share(Surface s, vec3 to_viewer, vec3 to_light, float base_weight, float coat_weight) {
  float n_dot_l = dot(s.normal, to_light);
  vec3 diffuse = (1.0f - s.metallic) * s.base_colour / pi;
  if (n_dot_l <= 0.0f) return s.translucency * diffuse * max(-n_dot_l, 0.0f);
  float n_dot_v = max(dot(s.normal, to_viewer), 1e-4f);
  float lower = min(n_dot_l, n_dot_v);
  vec3 h = normalize(to_viewer + to_light);
  float n_dot_h = clamp(dot(s.normal, h), 0.0f, 1.0f);
  float facing = schlick_weight(clamp(dot(to_viewer, h), 0.0f, 1.0f));
  vec3 f0 = specular_f0(s);
  vec3 fresnel = f0 + (vec3(1.0f) - f0) * facing;
  float highlight = base_weight * ggx_specular(s.roughness, n_dot_l, n_dot_v, n_dot_h);
  vec3 base = (vec3(1.0f) - base_reflectance(s, lower)) * diffuse + fresnel * highlight;
  float coat = s.clear_coat * (0.04f + 0.96f * facing);
  float coat_highlight = coat * coat_weight * ggx_specular(s.clear_coat_roughness, n_dot_l, n_dot_v, n_dot_h);
  return ((1.0f - fresnel_of_coat(s, lower)) * base + vec3(coat_highlight)) * n_dot_l;
}

// Radiance toward the viewer from light of `irradiance` (on a plane that faces it) from `to_light`.
GLSL_FUNCTION vec3 direct_radiance(Surface s, vec3 to_viewer, vec3 to_light, vec3 irradiance) {
  return scattered_share(s, to_viewer, to_light, 1.0f, 1.0f) * irradiance;
}

// Radiance toward the viewer from the surroundings: `irradiance` of the normal's hemisphere and of the one behind
// (leaves), and `base_reflection`, `coat_reflection`: radiance from the mirror direction, blurred for each roughness.
GLSL_FUNCTION vec3 ambient_radiance(Surface s, vec3 to_viewer, vec3 irradiance, vec3 irradiance_behind,
                                    vec3 base_reflection, vec3 coat_reflection) {
  float n_dot_v = clamp(dot(s.normal, to_viewer), 1e-4f, 1.0f);
  vec3 reflectance = base_reflectance(s, n_dot_v);
  vec3 diffuse = (1.0f - s.metallic) * s.base_colour / pi;
  vec3 scattered = (vec3(1.0f) - reflectance) * diffuse * (irradiance + s.translucency * irradiance_behind);
  float coat = fresnel_of_coat(s, n_dot_v);
  return (1.0f - coat) * (s.occlusion * scattered + reflectance * base_reflection) + coat * coat_reflection +
         s.emission;
}
