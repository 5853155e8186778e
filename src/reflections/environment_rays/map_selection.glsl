// Selection of the reference maps that show a hit best (Meyer and Loscos 2003, section 4.3). Needs
// map_surface.glsl.

uvec4 maps_around(vec3 at) {
  ivec2 cells = textureSize(map_choice, 0);
  ivec2 cell = clamp(ivec2((at.xy - choice_grid.xy) / choice_grid.z), ivec2(0), cells - ivec2(1));
  return texelFetch(map_choice, cell, 0);
}

// Position of a map; w: its layer.
vec4 place_of(uint map) { return vec4(texelFetch(map_places, ivec2(int(map), 0), 0).xyz, float(map)); }

// The two of the four maps around the reflecting point that show the hit best. Returns how well one of them
// sees it: 0 where something hides it from all.
float choose_maps(vec3 at, vec3 direction, vec3 hit, out vec4 places[2], out float weights[2]) {
  uvec4 maps = maps_around(at);
  weights = float[2](-1.0f, -1.0f);
  float seen = 0.0f;
  for (int k = 0; k < 4; ++k) {
    vec4 place = place_of(maps[k]);
    vec3 to_hit = hit - place.xyz;
    float distance_m = length(to_hit);
    float valid = validity(min_seen_distance(to_hit / distance_m, place.w), distance_m, height_grid.z);
    seen = max(seen, valid);
    // The closer a map is to the ray, the less an error in the hit's distance displaces the lookup.
    vec3 away = place.xyz - at;
    float along = dot(away, direction);
    float off_ray = dot(away, away) - along * along;
    // Section 4.3: where no map sees the hit, the one with the largest weight otherwise.
    float weight = (valid + 1e-4f) / (0.5f + off_ray + 0.2f * along * along);
    if (weight > weights[0]) {
      weights[1] = weights[0];
      places[1] = places[0];
      weights[0] = weight;
      places[0] = place;
    } else if (weight > weights[1]) {
      weights[1] = weight;
      places[1] = place;
    }
  }
  return seen;
}
