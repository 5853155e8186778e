// A surface in the light of a scene: the sun, the sky, the air. One recipe for every view and for the ray
// tracer.

struct SceneLight {
  vec3 to_sun;          // unit
  vec3 sun_irradiance;  // on a plane that faces the sun
  vec3 sky_sh[9];       // irradiance of the sky, shading/sky.glsl
  vec3 bounced;         // irradiance by other surfaces, shading/bounced_light.glsl
  vec3 bounced_behind;  // the same on the other side
  vec3 haze_radiance;
  float haze_per_m;
};

// Radiance that leaves `position` toward the viewer. `sun_visible` 0..1; `sky_visible` 0..1, the open share
// of the sky above the surface; the two reflections are the radiance from the mirror direction blurred for
// the roughness of the base and of the coat. Haze is not yet in.
GLSL_FUNCTION vec3 lit_radiance(Surface s, SceneLight light, vec3 to_viewer, float sun_visible,
                                float sky_visible, vec3 base_reflection, vec3 coat_reflection) {
  vec3 sun = direct_radiance(s, to_viewer, light.to_sun, sun_visible * light.sun_irradiance);
  vec3 irradiance = sky_visible * sky_irradiance(light.sky_sh, s.normal) + light.bounced;
  vec3 irradiance_behind = sky_visible * sky_irradiance(light.sky_sh, -s.normal) + light.bounced_behind;
  return sun +
         ambient_radiance(s, to_viewer, irradiance, irradiance_behind, base_reflection, coat_reflection);
}

// What the sun adds to a surface whose diffuse light holds the sun's already: its highlights.
GLSL_FUNCTION vec3 sun_highlights(Surface s, vec3 to_viewer, vec3 to_sun, vec3 irradiance) {
  return (scattered_share(s, to_viewer, to_sun, 1.0f, 1.0f) -
          scattered_share(s, to_viewer, to_sun, 0.0f, 0.0f)) *
         irradiance;
}

// The same as lit_radiance for a surface whose diffuse light was found at its vertices, with all that hides
// sky and sun (`irradiance` before it and `irradiance_behind` it): the thesis's emissive colour, diffuse
// times radiance (appendix A.2.2). The sun, as directional light, adds its highlights alone.
GLSL_FUNCTION vec3 vertex_lit_radiance(Surface s, SceneLight light, vec3 irradiance, vec3 irradiance_behind,
                                       vec3 to_viewer, float sun_visible, vec3 base_reflection,
                                       vec3 coat_reflection) {
  return sun_highlights(s, to_viewer, light.to_sun, sun_visible * light.sun_irradiance) +
         ambient_radiance(s, to_viewer, irradiance, irradiance_behind, base_reflection, coat_reflection);
}
