// Light of leaves and twigs that was found at their corners (leaf_light.glsl), and what of it they send to
// the viewer.
#include "graphics/shading/octahedral.glsl"
#include "graphics/shading/surface.glsl"
#include "graphics/shading/lamps.glsl"

// All but the sun, on the viewer's side.
struct CornerLight {
  vec3 irradiance;  // of sky and bounced light
  vec3 irradiance_behind;
  vec3 of_lamps;  // irradiance, with what comes through from behind
  vec3 mirrored;  // radiance toward the viewer
};

// Radiance toward the viewer, without the sun's.
vec3 radiance_of_corner_light(Surface s, vec3 to_viewer, CornerLight light) {
  s.emission += light.mirrored;
  LampLight lamps = no_lamp_light();
  lamps.irradiance = light.of_lamps;
  return ambient_radiance(s, to_viewer, light.irradiance, light.irradiance_behind, vec3(0.0f), vec3(0.0f)) +
         lamp_radiance(s, to_viewer, lamps);
}
