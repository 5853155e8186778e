// The light that falls on leaves and twigs, found at their corners: a crown covers more pixels than it has
// corners, and a renderer shades whole blocks of pixels for a leaf of two. To be included behind
// surface_outputs.glsl.
#include "graphics/render/frame.glsl"
#include "graphics/render/corner_light.glsl"
#include "graphics/render/lamp_lookup.glsl"
#include "graphics/render/sun_lookup.glsl"
#include "graphics/render/surroundings.glsl"
#include "graphics/shading/lighting.glsl"

#ifdef IS_LEAF
// All but the sun's, by what is open of the sky before the corner, and by what other leaves of the plant
// leave of it and of all that stands around (`openness`). `normal` is unit and on the viewer's side.
CornerLight corner_light(vec3 normal, vec4 sky_cell, float openness, vec3 to_viewer, float roughness,
                         float translucency) {
  BouncedCell bounced = bounced_cell(position, normal);
  vec3 share = sky_share_of_normal(sky_cell, normal) * bounced.sky;
  CornerLight light;
  light.irradiance = openness * (share * frame_sky_irradiance(normal) + bounced_irradiance(bounced, normal));
  light.irradiance_behind =
      openness * (share * frame_sky_irradiance(-normal) + bounced_irradiance(bounced, -normal));

  vec4 layers = vec4(0.0f, roughness, 0.0f, 0.0f);  // what mirrors has no colour of its own
  Surface blade = assembled_surface(normal, vec3(0.0f), vec3(1.0f), vec3(0.0f), layers, translucency);
  LampLight lamps = lamp_light(blade, position, normal, to_viewer);
  light.of_lamps = lamps.irradiance + translucency * lamps.irradiance_behind;
  light.mirrored = openness * base_reflectance(blade, clamp(dot(normal, to_viewer), 1e-4f, 1.0f)) *
                       surroundings_radiance(sky_cell, bounced, reflect(-to_viewer, normal), roughness) +
                   lamps.highlight + lamps.glow;
  return light;
}

#ifdef IS_SPECK
// Sets what a speck sends to the viewer through the haze.
void light_speck(Surface s, vec4 sky_cell, float openness) {
  vec3 to_viewer = viewer_position.xyz - position;
  float distance_m = length(to_viewer);
  to_viewer /= distance_m;
  vec3 sunless = radiance_of_corner_light(
      s, to_viewer, corner_light(s.normal, sky_cell, openness, to_viewer, s.roughness, s.translucency));
  vec3 sunlight = direct_radiance(s, to_viewer, to_sun_at(position), frame_sun_irradiance.rgb);
  speck_radiance = through_haze(sunless, distance_m, frame_to_sun.w, frame_haze.rgb);
  speck_sunlight = through_haze(sunlight, distance_m, frame_to_sun.w, vec3(0.0f));
}
#else
// Sets what pixels need, whose own normals and colours count.
void light_corner(vec3 normal, vec4 sky_cell, float openness, float roughness, float translucency) {
  vec3 to_viewer = normalize(viewer_position.xyz - position);
  CornerLight light = corner_light(normal, sky_cell, openness, to_viewer, roughness, translucency);
  leaf_light = light.irradiance;
  leaf_light_behind = light.irradiance_behind;
  leaf_lamps = light.of_lamps;
  leaf_mirrored = light.mirrored;
}
#endif
#endif
