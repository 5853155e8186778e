// Curved reflectors: where the picture of virtual objects shows one, that; elsewhere the sky.
#include "render/surface_body.glsl"

uniform sampler2D virtual_picture;  // of the main view's size, coverage in alpha

vec3 mirrored_direction;

void look_along(vec3 at, vec3 direction) { mirrored_direction = direction; }

vec3 reflected_radiance(float roughness) {
  vec4 seen = texelFetch(virtual_picture, ivec2(gl_FragCoord.xy), 0);
  return seen.rgb + (1.0f - seen.a) * sky_share_of_direction(surface_sky_cell, mirrored_direction) *
                        sky_radiance(mirrored_direction, roughness);
}
