// Billboards of captured trees: where they stand was decided for this view (tree_drawable.cpp).
#define IS_LEAF  // light is evaluated at the corners alone: surface_outputs.glsl
#include "graphics/render/frame.glsl"
#include "graphics/render/body_lookup.glsl"
#include "graphics/render/sky_lookup.glsl"
#include "graphics/render/sun_lookup.glsl"
#include "graphics/render/surface_outputs.glsl"

layout(location = 0) in vec4 billboard_centre;  // in the world; w: share of the second photograph
layout(location = 1) in vec3 half_right;        // in the world, metres
layout(location = 2) in vec3 half_up;
layout(location = 3) in vec4 billboard_slants;  // of the cell's silhouette, billboard.glsl
layout(location = 4) in vec4 base_colour_of_cell;
layout(location = 5) in uvec3 tiles_and_thing;  // textures of the two photographs; number of the thing
layout(location = 6) in float reach;            // of the quad, in half billboards
// Factor from textures to albedo, shares of sun and sky that the crown lets through, metres toward the sun
// beyond which the crown ends.
layout(location = 7) in vec4 light_in_crown;

flat out vec4 slants;
flat out vec4 base_of_cell;  // sRGB and opacity, where a photograph has no texture
flat out uvec2 tiles;
flat out float second_share;
flat out float albedo_factor;

void surface_vertex() {
  vec2 corner = reach * (vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 2.0f - 1.0f);
  position = billboard_centre.xyz + corner.x * half_right + corner.y * half_up;
  vertex_normal = cross(half_right, half_up);
  uv = corner;
  slants = billboard_slants;
  base_of_cell = base_colour_of_cell;
  tiles = tiles_and_thing.xy;
  second_share = billboard_centre.w;
  vec3 facing = normalize(vertex_normal);
  albedo_factor = light_in_crown.x;
  // The crown's own shadow is its cells' share of the sun; the maps have that of all else.
  leaf_sun = light_in_crown.y * visible_sun(position + light_in_crown.w * to_sun_at(position), facing);
  leaf_sky_cell = shaded_cell(sky_visibility_cell(position, facing),
                              sky_share_beside_bodies(position, facing, int(tiles_and_thing.z)));
  leaf_sky_cell = mix(vec4(0.5f, 0.5f, 0.5f, 0.0f), leaf_sky_cell, light_in_crown.z);
  object_of_surface = int(tiles_and_thing.z);
}
