// Light that surfaces reflect onto each other, at texture unit 10: a grid whose lower half holds lobes and
// whose upper half colours (graphics/shading/bounced_light.glsl).
#include "graphics/render/frame.glsl"
#include "graphics/shading/bounced_light.glsl"

uniform highp sampler3D bounced_light_texture;

// Irradiance on both sides of a surface.
struct BouncedSides {
  vec3 front, behind;
};

BouncedSides bounced_light_at(vec3 at, vec3 geometric_normal, vec3 normal) {
  BouncedSides sides = BouncedSides(vec3(0.0f), vec3(0.0f));
  int rounds = frame_bounced_size.w > 0.5f ? 1 : 0;  // no branch: a loop without rounds is left out
  for (int i = 0; i < rounds; ++i) {
    BouncedGrid grid = BouncedGrid(frame_bounced_origin.xyz, frame_bounced_size.xyz, frame_bounced_origin.w,
                                   frame_bounced_size.w);
    vec3 cell = bounced_coordinates(grid, at, geometric_normal);
    vec4 lobe = textureLod(bounced_light_texture, cell, 0.0f);
    vec3 colour = textureLod(bounced_light_texture, cell + vec3(0.0f, 0.0f, 0.5f), 0.0f).rgb;
    sides = BouncedSides(bounced_irradiance(lobe, colour, normal), bounced_irradiance(lobe, colour, -normal));
  }
  return sides;
}
