// Light that no reference map holds: shadows of dynamic objects on the ground, and the radiance of dynamic
// objects themselves.

const float max_ground_error_m =
    0.2f;  // a cell has one height: beside a kerb a hit may lie inside the pavement

// Visibility of the sun without dynamic objects. Beside a wall the shadow map leaks light by a texel or two;
// a second lookup, a step toward the sun, is inside the wall.
float visible_sun_without_bodies(vec3 point, vec3 normal) {
  vec2 step_m = 2.0f * frame_shadow_texel.x * frame_to_sun.xy / max(length(frame_to_sun.xy), 1e-4f);
  return min(visible_fixed_sun(point, normal), visible_fixed_sun(point + vec3(step_m, 0.0f), normal));
}

// Irradiance by the part of the sky that is seen from a place, without dynamic objects.
vec3 irradiance_of_sky(vec3 point, vec3 normal, BouncedCell bounced) {
  vec3 share = sky_share_of_normal(sky_visibility_cell(point, normal), normal) * bounced.sky;
  return share * frame_sky_irradiance(normal);
}

// Light at a place, without the shade of dynamic objects on its sky.
struct PlaceLight {
  vec3 sky;     // irradiance by the part of the sky that is seen
  vec3 others;  // and by other surfaces and lamps
  float sun;    // share of the sun that is seen, beside dynamic objects
};

// `sun_point`: where the sun is looked for.
PlaceLight light_at(vec3 point, vec3 normal, vec3 sun_point) {
  BouncedCell bounced = bounced_cell(point, normal);
  PlaceLight light;
  light.sky = irradiance_of_sky(point, normal, bounced);
  light.others = bounced_irradiance(bounced, normal) + irradiance_of_lamps(point, normal);
  light.sun = visible_sun(sun_point, normal);
  return light;
}

// Above the ground that a kerb hides.
vec3 above_ground(vec3 point) {
  return point + max_ground_error_m / max(frame_to_sun.z, 0.2f) * frame_to_sun.xyz;
}

// Ratio of the ground's irradiance with and without dynamic objects: no map shows the shadows of cars. Walls
// are left out, because the height field is too coarse for them.
vec3 light_left_by_bodies(vec3 point, vec3 normal, PlaceLight light) {
  vec3 sun = max(dot(normal, frame_to_sun.xyz), 0.0f) * frame_sun_irradiance.rgb;
  float fixed_sun = visible_sun_without_bodies(point, normal);
  float sun_share = min(light.sun, fixed_sun);
  float sky_share = sky_share_beside_bodies(point, normal, -1);
  return (sky_share * light.sky + sun_share * sun + light.others) /
         max(light.sky + fixed_sun * sun + light.others, vec3(1e-4f));
}

// Radiance of a dynamic object: diffuse colour below a clear coat, which reflects the map nearest to it.
vec3 radiance_of_body(BodyHit body, vec3 direction, float map, PlaceLight light) {
  float facing_sun = max(dot(body.normal, frame_to_sun.xyz), 0.0f);
  vec3 irradiance = light.sky + light.others + facing_sun * light.sun * frame_sun_irradiance.rgb;
  vec2 uv = layer_uv(reflect(direction, body.normal), gloss_side, gloss_border);
  vec3 mirrored = textureLod(map_glosses, vec3(gloss_uv(uv, 0.0f), map), 0.0f).rgb;
  float mirrors = 0.04f + 0.96f * schlick_weight(-dot(direction, body.normal));
  return (1.0f - mirrors) / pi * body.base_colour * irradiance + mirrors * mirrored;
}
