// Billboards of captured trees: where they stand was decided for this view (tree_drawable.cpp).
#include "graphics/render/frame.glsl"
#include "graphics/render/surface_outputs.glsl"
#if !defined(WRITES_DEPTH) && !defined(WRITES_OBJECT)
#define HAS_LIGHT
#include "capture/trees/leaf_light.glsl"
#endif

layout(location = 0) in vec4 billboard_centre;  // in the world; w: share of the second photograph
layout(location = 1) in vec4 half_right;        // in the world, metres; w: mip level of the textures
layout(location = 2) in vec3 half_up;
layout(location = 3) in vec4 billboard_slants;  // of the cell's silhouette, billboard.glsl
layout(location = 4) in vec4 base_colour_of_cell;
layout(location = 5) in uvec4 tiles_and_thing;  // textures of the two photographs; thing; layer of detail
layout(location = 6) in vec4 extent;            // of the quad, in half billboards: low and high corner
layout(location = 7) in vec3 light_in_crown;    // factor from textures to albedo, shares of sun and sky
layout(location = 9) in vec4 exit_distances;    // of each corner: metres toward the sun to the crown's end
layout(location = 8) in vec4 texture_scales;    // from the billboard to those of the two photographs
#ifdef HAS_DETAIL
layout(location = 10) in vec4 detail_place;  // of the middle in tiles of detail; tiles per half billboard
#endif

flat out vec4 slants;
flat out vec4 base_of_cell;  // sRGB and opacity, where a photograph has no texture
flat out uvec2 tiles;
flat out vec4 scales;
flat out vec3 share_level_factor;  // of the second photograph; mip level; factor from textures to albedo
#ifdef HAS_DETAIL
flat out vec4 place_in_detail;
flat out float detail_layer;
#endif
#ifdef HAS_LIGHT
out vec3 highlight_of_leaves;  // LeafLight
out vec3 radiance_per_albedo;
#endif

void surface_vertex() {
  vec2 corner = mix(extent.xy, extent.zw, vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)));
  position = billboard_centre.xyz + corner.x * half_right.xyz + corner.y * half_up;
  vertex_normal = cross(half_right.xyz, half_up);
  uv = corner;
  slants = billboard_slants;
  base_of_cell = base_colour_of_cell;
  tiles = tiles_and_thing.xy;
  scales = texture_scales;
  share_level_factor = vec3(billboard_centre.w, half_right.w, light_in_crown.x);
  object_of_surface = int(tiles_and_thing.z);
#ifdef HAS_DETAIL
  place_in_detail = detail_place;
  detail_layer = float(tiles_and_thing.w);
#endif
#ifdef HAS_LIGHT
  LeafLight light = light_of_leaves(position, normalize(vertex_normal), light_in_crown.yz,
                                    exit_distances[gl_VertexID], int(tiles_and_thing.z));
  highlight_of_leaves = light.highlight;
  radiance_per_albedo = light.per_albedo;
#endif
}
