// Radiance that reference maps show along a mirror ray, filtered for the pixel's footprint and the roughness
// of the surface's layers. Needs the maps' uniforms, `reflected` and reference_maps/map_levels.glsl.
//
// A software renderer runs every branch, and a loop's body once more than it has rounds where the condition
// comes first. Lookups of both layers share one loop, which ends behind the last that a pixel needs.

const float max_taps = 4.0f;

// A map that is looked into: the vector from its middle to the hit, and its layer.
struct MapView {
  vec3 to_hit;
  float map;
};

// Radiance for the roughness of a surface's base and of its coat.
struct LayerRadiance {
  vec3 base;
  vec3 coat;
};

// Lookups along the major axis of a footprint, each as wide as its minor axis.
struct FootprintTaps {
  float count;
  float level;
};

// Anisotropic filtering: the footprint of a curved mirror is long and thin.
FootprintTaps taps_of(MapView view, float roughness) {
  float lobe = lobe_texels(roughness, layer_size.x);
  float texels_per_m = layer_size.x / layer_rad / length(view.to_hit);
  float wide = length(reflected.across) * texels_per_m;
  float thin = sqrt(reflected.narrow * reflected.narrow * texels_per_m * texels_per_m + lobe * lobe);
  float count = clamp(ceil(wide / max(thin, 1.0f)), 1.0f, max_taps);
  return FootprintTaps(count, log2(max(max(wide / count, thin), 1.0f)) - 0.5f);
}

// Of the layers whose lobe is sharp as seen from the map; black of the others.
LayerRadiance sharp_radiance(MapView view, vec2 roughness) {
  FootprintTaps base = taps_of(view, roughness.x), coat = taps_of(view, roughness.y);
  if (roughness.x >= min_gloss) base.count = 0.0f;
  if (roughness.y >= min_gloss) coat.count = 0.0f;
  LayerRadiance sum = LayerRadiance(vec3(0.0f), vec3(0.0f));
  float i = 0.5f;
  do {
    bool is_base = i < base.count, is_coat = !is_base && i < base.count + coat.count;
    float along = is_base ? i / base.count : (i - base.count) / max(coat.count, 1.0f);
    vec2 uv =
        layer_uv(normalize(view.to_hit + (along - 0.5f) * reflected.across), layer_size.x, layer_size.y);
    vec3 seen = textureLod(map_colours, vec3(uv, view.map), is_base ? base.level : coat.level).rgb;
    sum.base += is_base ? seen : vec3(0.0f);
    sum.coat += is_coat ? seen : vec3(0.0f);
    ++i;
  } while (i < base.count + coat.count);
  sum.base /= max(base.count, 1.0f);
  sum.coat /= max(coat.count, 1.0f);
  return sum;
}

vec3 glossy_radiance(float map, vec3 direction, float roughness) {
  vec3 tiles = gloss_tiles(roughness);
  vec2 uv = layer_uv(direction, gloss_side, gloss_border);
  vec3 sharper = textureLod(map_glosses, vec3(gloss_uv(uv, tiles.x), map), 0.0f).rgb;
  vec3 rougher = textureLod(map_glosses, vec3(gloss_uv(uv, tiles.y), map), 0.0f).rgb;
  return mix(sharper, rougher, tiles.z);
}

// What one map shows. `over_ground`: see reflected_radiance.
LayerRadiance radiance_in_map(MapView view, vec2 roughness, float over_ground) {
  // A lobe that hits near the reflector is narrow as seen from a map farther away.
  vec2 seen_roughness = roughness * sqrt(min(reflected.distance / length(view.to_hit), 1.0f));
  vec3 to_hit = normalize(view.to_hit);
  LayerRadiance seen = sharp_radiance(view, seen_roughness);
  bool base_is_glossy = seen_roughness.x >= min_gloss, passes_ground = over_ground > 0.0f,
       coat_is_glossy = seen_roughness.y >= min_gloss;
  bool continues;
  do {
    bool is_base = base_is_glossy, is_over_ground = !is_base && passes_ground,
         is_coat = !is_base && !is_over_ground && coat_is_glossy;
    vec3 glossy = glossy_radiance(view.map, is_over_ground ? normalize(to_hit + reflected.direction) : to_hit,
                                  is_base          ? seen_roughness.x
                                  : is_over_ground ? roughness.x
                                                   : seen_roughness.y);
    if (is_base) seen.base = glossy, base_is_glossy = false;
    if (is_over_ground) seen.base = mix(seen.base, glossy, over_ground), passes_ground = false;
    if (is_coat) seen.coat = glossy, coat_is_glossy = false;
    continues = base_is_glossy || passes_ground || coat_is_glossy;
  } while (continues);
  return seen;
}
