// Radiance that reference maps show along a mirror ray, filtered for the pixel's footprint and the surface's
// roughness. Needs the maps' uniforms, `reflected` and reference_maps/map_levels.glsl.

const float max_taps = 4.0f;

// Anisotropic filtering: the footprint of a curved mirror is long and thin; lookups along its major axis,
// each as wide as its minor axis.
vec3 sharp_radiance(int k, float lobe) {
  float texels_per_m = layer_size.x / layer_rad / length(reflected.from_map[k]);
  float wide = length(reflected.across) * texels_per_m;
  float thin = sqrt(reflected.narrow * reflected.narrow * texels_per_m * texels_per_m + lobe * lobe);
  float taps = clamp(ceil(wide / max(thin, 1.0f)), 1.0f, max_taps);
  float level = log2(max(max(wide / taps, thin), 1.0f)) - 0.5f;
  vec3 sum = vec3(0.0f);
  for (float i = 0.5f; i < taps; ++i) {
    vec3 to_point = reflected.from_map[k] + (i / taps - 0.5f) * reflected.across;
    vec2 uv = layer_uv(normalize(to_point), layer_size.x, layer_size.y);
    sum += textureLod(map_colours, vec3(uv, reflected.map[k]), level).rgb;
  }
  return sum / taps;
}

vec3 glossy_radiance(int k, vec3 direction, float roughness) {
  vec3 tiles = gloss_tiles(roughness);
  vec2 uv = layer_uv(direction, gloss_side, gloss_border);
  vec3 sharper = textureLod(map_glosses, vec3(gloss_uv(uv, tiles.x), reflected.map[k]), 0.0f).rgb;
  vec3 rougher = textureLod(map_glosses, vec3(gloss_uv(uv, tiles.y), reflected.map[k]), 0.0f).rgb;
  return mix(sharper, rougher, tiles.z);
}
