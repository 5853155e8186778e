// The light that hits a surface: sun, sky and bounced light of the frame, and how much of sun and sky
// reaches the point. Stores `surface_bounced_cell`.
SceneLight scene_light(vec3 geometric_normal, vec3 normal) {
  SceneLight light;
  light.to_sun = to_sun_at(position);
  light.sun_irradiance = frame_sun_irradiance.rgb;
  surface_bounced_cell = bounced_cell(position, geometric_normal);
  for (int i = 0; i < 9; ++i) light.sky_sh[i] = surface_bounced_cell.sky * frame_sky_sh[i].rgb;
  light.bounced = bounced_irradiance(surface_bounced_cell, normal);
  light.bounced_behind = bounced_irradiance(surface_bounced_cell, -normal);
  light.haze_radiance = frame_haze.rgb;
  light.haze_per_m = frame_to_sun.w;
  return light;
}

// Of objects that receive no shadows, the complement of their number is given.
int surface_object() { return object_of_surface < 0 ? ~object_of_surface : object_of_surface; }

// What a surface sees in one direction where no ray is traced and no map shows it.
vec3 unmapped_radiance(vec3 direction, float roughness) {
  return surroundings_radiance(surface_sky_cell, surface_bounced_cell, direction, roughness);
}

#ifndef WRITES_SURFACE
// The sun as rays found it in the pixel or beside it, where they hit this surface; else as the maps have it.
// Where a neighbour is as far away but for rounding, the pixel's own ray counts.
float traced_sun(float drawn, float distance_m) {
  float share = drawn, nearest = 0.01f * distance_m;
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  bool are_traced = frame_shadow_extra.y > 0.5f;
  int taps = are_traced ? 5 : 1, i = 0;
  do {
    ivec2 beside = ivec2(int(i == 1) - int(i == 2), int(i == 3) - int(i == 4));
    vec2 traced =
        texelFetch(traced_sun_texture, clamp(pixel + beside, ivec2(0), ivec2(frame_size.xy) - 1), 0).rg;
    float off = abs(traced.g - distance_m) + (i > 0 ? 2e-5f * distance_m : 0.0f);
    share = are_traced && off < nearest ? traced.r * sun_cone(to_sun_at(position)) : share;
    nearest = min(off, nearest);
  } while (++i < taps);
  return share;
}
#endif

// Share of the sky that is seen, stored in `surface_sky_cell`.
void look_at_sky(SeenPoint seen) {
  surface_sky_cell = shaded_cell(sky_visibility_cell(position, seen.normal),
                                 sky_share_beside_bodies(position, seen.normal, surface_object()));
}

// Share of the sun that is seen.
float seen_sun(SeenPoint seen) {
#ifdef IS_LEAF
  float drawn = clamp(leaf_sun, 0.0f, 1.0f);  // the middle of a pixel may lie outside of a small leaf
#else
  float drawn = visible_sun(position, seen.normal);
#endif
#ifndef WRITES_SURFACE
  drawn = traced_sun(drawn, seen.distance_m);
#endif
  return object_of_surface < 0 ? sun_cone(to_sun_at(position)) : drawn;
}
