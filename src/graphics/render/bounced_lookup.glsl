// Light that surfaces reflect onto each other, at texture unit 10: a grid whose lowest third holds lobes, the
// next one colours and the last one skies (graphics/shading/bounced_light.glsl).
#include "graphics/render/frame.glsl"
#include "graphics/shading/bounced_light.glsl"

uniform highp sampler3D bounced_light_texture;

// The cell before a surface; without light, and under the whole sky, where the scene has no bounced light.
BouncedCell bounced_cell(vec3 at, vec3 geometric_normal) {
  BouncedCell before = BouncedCell(vec4(0.0f), vec3(0.0f), vec3(1.0f));
  if (frame_bounced_size.w > 0.5f) {
    BouncedGrid grid = BouncedGrid(frame_bounced_origin.xyz, frame_bounced_size.xyz, frame_bounced_origin.w,
                                   frame_bounced_size.w);
    vec3 cell = bounced_coordinates(grid, at, geometric_normal);
    before.lobe = textureLod(bounced_light_texture, cell, 0.0f);
    before.colour = textureLod(bounced_light_texture, cell + vec3(0.0f, 0.0f, 1.0f / 3.0f), 0.0f).rgb;
    before.sky = textureLod(bounced_light_texture, cell + vec3(0.0f, 0.0f, 2.0f / 3.0f), 0.0f).rgb;
  }
  return before;
}
