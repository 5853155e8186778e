// The light of a billboard of leaves at one of its corners. What leaves radiate is affine in their albedo:
// corners carry its two coefficients, so that a pixel, which shows many billboards behind each other, costs
// two texture lookups and a product each.
#include "graphics/render/frame.glsl"
#include "graphics/render/body_lookup.glsl"
#include "graphics/render/bounced_lookup.glsl"
#include "graphics/render/lamp_lookup.glsl"
#include "graphics/render/sky_lookup.glsl"
#include "graphics/render/sun_lookup.glsl"
#include "graphics/shading/surface.glsl"
#include "graphics/shading/lighting.glsl"
#include "capture/trees/foliage.glsl"

struct LeafLight {
  vec3 highlight;   // radiance of leaves of no albedo
  vec3 per_albedo;  // what is added for an albedo of 1 beyond the leaves' highlight (without_highlight)
};

// `shares`: of sun and sky that the crown lets through to the billboard. `to_viewer`: unit, the billboard's
// normal. `exit_distance_m`: metres toward the sun beyond which the crown ends.
LeafLight light_of_leaves(vec3 position, vec3 to_viewer, vec2 shares, float exit_distance_m, int thing) {
  SceneLight light;
  light.to_sun = to_sun_at(position);
  light.sun_irradiance = frame_sun_irradiance.rgb;
  Surface bare = foliage_surface(vec3(0.0f), light.to_sun, to_viewer);
  Surface white = foliage_surface(vec3(1.0f + leaf_highlight), light.to_sun, to_viewer);
  BouncedCell bounced = bounced_cell(position, to_viewer);
  for (int i = 0; i < 9; ++i) light.sky_sh[i] = bounced.sky * frame_sky_sh[i].rgb;
  light.bounced = bounced_irradiance(bounced, bare.normal);
  light.bounced_behind = bounced_irradiance(bounced, -bare.normal);
  // The crown's own shadow is its cells' share of the sun; the maps have that of all else, seen from a point
  // in the air: of no surface whose plane would tilt the comparison.
  float sun = shares.x * visible_sun(position + exit_distance_m * light.to_sun, light.to_sun);
  vec4 cell = shaded_cell(sky_visibility_cell(position, to_viewer),
                          sky_share_beside_bodies(position, to_viewer, thing));
  cell = mix(vec4(0.5f, 0.5f, 0.5f, 0.0f), cell, shares.y);
  float sky = sky_share_of_normal(cell, bare.normal);
  vec3 mirrored = reflect(-to_viewer, bare.normal);
  vec3 reflection = sky_share_of_direction(cell, mirrored) * sky_radiance(mirrored, 1.0f) +
                    bounced_radiance(bounced, mirrored);
  LampLight lamps = lamp_light(bare, position, to_viewer, to_viewer);
  LeafLight result;
  result.highlight = lit_radiance(bare, light, to_viewer, sun, sky, reflection, vec3(0.0f)) +
                     lamp_radiance(bare, to_viewer, lamps);
  result.per_albedo = lit_radiance(white, light, to_viewer, sun, sky, reflection, vec3(0.0f)) +
                      lamp_radiance(white, to_viewer, lamps) - result.highlight;
  return result;
}
