// The sky picture with its blurred levels, at texture unit 4, and how much of it a place sees, at unit 15.
#include "graphics/render/frame.glsl"
#include "graphics/shading/sky.glsl"
#include "graphics/shading/sky_visibility.glsl"

uniform sampler2D sky_texture;
uniform sampler3D sky_visibility_texture;

vec3 sky_radiance(vec3 direction, float roughness) {
  return textureLod(sky_texture, equirect_uv(direction, frame_haze.w), sky_level(roughness, frame_size.z))
      .rgb;
}

// Irradiance of the open sky on a surface with this unit normal.
vec3 frame_sky_irradiance(vec3 normal) {
  vec3 sh[9];
  for (int i = 0; i < 9; ++i) sh[i] = frame_sky_sh[i].rgb;
  return sky_irradiance(sh, normal);
}

vec4 sky_visibility_cell(vec3 at, vec3 geometric_normal) {
  SkyVisibilityGrid grid =
      SkyVisibilityGrid(frame_visibility_origin.xyz, frame_visibility_size.xyz, frame_visibility_origin.w);
  return textureLod(sky_visibility_texture, sky_visibility_coordinates(grid, at, geometric_normal), 0.0f);
}
