// What light does at a surface: Lambert and GGX (Walter 2007) with all bounces between facets (Kulla and
// Conty 2017) under a clear coat (glTF KHR_materials_clearcoat), translucent leaves. Shared by shaders and
// ray tracer.

struct Surface {
  vec3 normal;       // unit, on the viewer's side
  vec3 base_colour;  // linear
  float metallic;
  float roughness;  // perceptual, alpha = roughness^2
  float clear_coat;
  float clear_coat_roughness;
  float translucency;
  float occlusion;  // 1: open to the sky
  vec3 emission;
};

// By the factors of a material (`layers`: metallic, roughness, clear coat, its roughness) and what its
// textures have at a point (`detail`: occlusion, roughness, metallic; glTF 2.0, section 3.9.2). Colours are
// products already.
GLSL_FUNCTION Surface assembled_surface(vec3 normal, vec3 base_colour, vec3 detail, vec3 emission,
                                        vec4 layers, float translucency) {
  Surface s;
  s.normal = normal;
  s.base_colour = base_colour;
  s.metallic = layers.x * detail.z;
  s.roughness = layers.y * detail.y;
  s.clear_coat = layers.z;
  s.clear_coat_roughness = layers.w;
  s.translucency = translucency;
  s.occlusion = detail.x;
  s.emission = emission;
  return s;
}

// What only shines: a black metal with light of its own, which neither sun nor sky change.
GLSL_FUNCTION Surface shining_surface(vec3 normal, vec3 emission) {
  return assembled_surface(normal, vec3(0.0f), vec3(1.0f), emission, vec4(1.0f, 1.0f, 0.0f, 0.03f), 0.0f);
}

// Highlights of the sun are not allowed to get sharper than this: a mirror would show the sun's disc, of 0.5
// degrees.
const float min_roughness = 0.05f;
const float pi = 3.14159265f;

GLSL_FUNCTION vec3 specular_f0(Surface s) { return mix(vec3(0.04f), s.base_colour, s.metallic); }

GLSL_FUNCTION float schlick_weight(float cosine) {
  float m = clamp(1.0f - cosine, 0.0f, 1.0f);
  return (m * m) * (m * m) * m;
}

GLSL_FUNCTION float ggx_alpha(float roughness) {
  return max(roughness, min_roughness) * max(roughness, min_roughness);
}

GLSL_FUNCTION float ggx_distribution(float alpha, float n_dot_h) {
  float a2 = alpha * alpha;
  float d = n_dot_h * n_dot_h * (a2 - 1.0f) + 1.0f;
  return a2 / (pi * d * d);
}

// GGX distribution times the visibility of Smith's correlated masking and shadowing (Heitz 2014).
GLSL_FUNCTION float ggx_specular(float roughness, float n_dot_l, float n_dot_v, float n_dot_h) {
  float alpha = ggx_alpha(roughness);
  float a2 = alpha * alpha;
  float visibility = 0.5f / (n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0f - a2) + a2) +
                             n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0f - a2) + a2));
  return ggx_distribution(alpha, n_dot_h) * visibility;
}

// What that lobe gives back of light from everywhere, each fitted to the integral: the share that would
// bounce again between facets and is lost (to 0.010), and the share that Schlick's weight has in the rest (to
// 0.006).
struct LobeShares {
  float lost;
  float grazing;
};

GLSL_FUNCTION LobeShares lobe_shares(float roughness, float n_dot_v) {
  float r = max(roughness, min_roughness);
  float u = n_dot_v / (n_dot_v + r * r);  // grazing is where facets are: the shares change little along it
  LobeShares shares;
  float l0 = 0.188377f + r * (-1.93355f + r * (7.7252f + r * (-14.5446f + r * (12.7403f - 4.14738f * r))));
  float l1 = -0.365997f + r * (3.03626f + r * (-6.50722f + r * (11.1926f - 4.69095f * r)));
  float l2 = 1.05228f + r * (-4.55133f + r * (-2.67824f + 0.533914f * r));
  float l3 = 0.769625f + r * (8.02479f + 0.982778f * r);
  float l4 = -4.69094f - 4.38752f * r;
  shares.lost = clamp(l0 + u * (l1 + u * (l2 + u * (l3 + u * (l4 + u * 3.04714f)))), 0.0f, 1.0f);
  float g0 = 1.18003f + r * (-3.71956f + r * (4.25935f + r * (-1.63303f - 0.0461515f * r)));
  float g1 = -0.327583f + r * (5.34836f + r * (-10.0836f + 4.99311f * r));
  float g2 = -1.17042f + r * (-4.43852f + 5.24253f * r);
  float g3 = 2.78988f + 3.44565f * r;
  shares.grazing = clamp(schlick_weight(n_dot_v) * (g0 + u * (g1 + u * (g2 + u * (g3 - 1.50824f * u)))), 0.0f,
                         1.0f - shares.lost);
  return shares;
}

// Their means over the hemisphere, weighted by the cosine: fitted to those of lobe_shares.
GLSL_FUNCTION LobeShares mean_lobe_shares(float roughness) {
  float r = max(roughness, min_roughness);
  LobeShares shares;
  shares.lost =
      0.00043645f +
      r * (0.231088f + r * (-2.8266f + r * (12.2797f + r * (-19.7938f + r * (15.7166f - 5.01274f * r)))));
  shares.grazing =
      0.0436666f + r * (0.107383f + r * (-0.793991f + r * (1.38353f + r * (-1.00881f + 0.271954f * r))));
  return shares;
}

// Share of the light lost between facets that leaves them after more bounces, coloured by each (Kulla and
// Conty 2017, Hill 2018); `mean` of mean_lobe_shares.
GLSL_FUNCTION vec3 returned_share(vec3 f0, LobeShares mean) {
  vec3 fresnel = f0 + (vec3(1.0f) - f0) / 21.0f;
  return fresnel * fresnel * (1.0f - mean.lost) / (vec3(1.0f) - fresnel * mean.lost);
}

GLSL_FUNCTION vec3 reflected_share(vec3 f0, LobeShares shares, vec3 returned) {
  return f0 * (1.0f - shares.lost - shares.grazing) + vec3(shares.grazing) + returned * shares.lost;
}

// Share of the radiance from around the mirror direction that goes to the viewer, for the base layer and for
// the coat.
GLSL_FUNCTION vec3 base_reflectance(Surface s, float n_dot_v) {
  vec3 f0 = specular_f0(s);
  return reflected_share(f0, lobe_shares(s.roughness, n_dot_v),
                         returned_share(f0, mean_lobe_shares(s.roughness)));
}

GLSL_FUNCTION float coat_share(float coat, LobeShares shares) {
  return coat * (0.04f * (1.0f - shares.lost - shares.grazing) + shares.grazing);
}

GLSL_FUNCTION float fresnel_of_coat(Surface s, float n_dot_v) {
  if (s.clear_coat <= 0.0f) return 0.0f;
  return coat_share(s.clear_coat, lobe_shares(s.clear_coat_roughness, n_dot_v));
}

// Share of the light from `to_light` that goes to the viewer: BRDF times cosine. What a layer reflects does
// not reach the ones below, on the way in or out; what comes out of them in all directions is scaled so that
// light is kept (Kelemen and Szirmay-Kalos 2001, Kulla and Conty 2017), and their highlight loses by the
// lower of the two directions. The highlights of base and coat count by their weights: 1, or 0 where a path
// follows their mirror ray instead.
GLSL_FUNCTION vec3 scattered_share(Surface s, vec3 to_viewer, vec3 to_light, float base_weight,
                                   float coat_weight) {
  float n_dot_l = dot(s.normal, to_light);
  vec3 colour = (1.0f - s.metallic) * s.base_colour;
  if (n_dot_l <= 0.0f) return s.translucency * colour / pi * max(-n_dot_l, 0.0f);
  float n_dot_v = clamp(dot(s.normal, to_viewer), 1e-4f, 1.0f);
  float lit = min(n_dot_l, 1.0f);
  vec3 h = normalize(to_viewer + to_light);
  float n_dot_h = clamp(dot(s.normal, h), 0.0f, 1.0f);
  float facing = schlick_weight(clamp(dot(to_viewer, h), 0.0f, 1.0f));

  vec3 f0 = specular_f0(s);
  LobeShares seen = lobe_shares(s.roughness, n_dot_v);
  LobeShares met = lobe_shares(s.roughness, lit);
  LobeShares mean = mean_lobe_shares(s.roughness);
  vec3 returned = returned_share(f0, mean);
  vec3 kept = (vec3(1.0f) - reflected_share(f0, seen, returned)) *
              (vec3(1.0f) - reflected_share(f0, met, returned)) /
              max(vec3(1.0f) - reflected_share(f0, mean, returned), vec3(1e-3f));
  vec3 spread = (kept * colour + returned * seen.lost * met.lost / max(mean.lost, 1e-3f)) / pi;
  vec3 highlight =
      (f0 + (vec3(1.0f) - f0) * facing) * (base_weight * ggx_specular(s.roughness, lit, n_dot_v, n_dot_h));
  if (s.clear_coat <= 0.0f) return (spread + highlight) * n_dot_l;

  float coat_seen = 1.0f - fresnel_of_coat(s, n_dot_v);
  float coat_met = 1.0f - fresnel_of_coat(s, lit);
  // Base and coat both reflect most at grazing angles: what one keeps out the other would have, too.
  float coat_mean =
      1.0f - coat_share(s.clear_coat, mean_lobe_shares(s.clear_coat_roughness)) + 0.01f * s.clear_coat;
  float coat = s.clear_coat * (0.04f + 0.96f * facing);
  float coat_highlight = coat * coat_weight * ggx_specular(s.clear_coat_roughness, lit, n_dot_v, n_dot_h);
  return (spread * (coat_seen * coat_met / coat_mean) + highlight * min(coat_seen, coat_met) +
          vec3(coat_highlight)) *
         n_dot_l;
}

// Radiance toward the viewer from light of `irradiance` (on a plane that faces it) from `to_light`.
GLSL_FUNCTION vec3 direct_radiance(Surface s, vec3 to_viewer, vec3 to_light, vec3 irradiance) {
  return scattered_share(s, to_viewer, to_light, 1.0f, 1.0f) * irradiance;
}

// Radiance toward the viewer from the surroundings: `irradiance` of the normal's hemisphere and of the one
// behind (leaves), and `base_reflection`, `coat_reflection`: radiance from the mirror direction, blurred for
// each roughness.
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
