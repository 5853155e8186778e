// Leaves of grown plants: corners of their meshes, or (IS_POINT) one point each, as large as the leaf is
// seen.
#include "life/vegetation/plant_record.glsl"
#include "life/vegetation/leaf_surface.glsl"

#ifdef IS_POINT
layout(location = 0) in vec3 leaf_middle;
layout(location = 1) in vec4 leaf_size;  // root of its area, openness, rank
layout(location = 2) in vec4 leaf_normal_and_tint;

uniform float pixels_at_w_1;  // per metre, where the clip coordinate w is 1
uniform float min_point_px;   // smaller points are left out by their area's chance, 0: none are
#else
flat out vec3 leaf_material;  // veins, translucency, roughness
out vec3 leaf_colour;

layout(location = 0) in vec3 leaf_foot;
layout(location = 1) in vec4 leaf_offset;  // from the foot; w: openness
layout(location = 2) in vec4 leaf_normal_and_tint;
layout(location = 3) in vec4 leaf_place;  // in leaf lengths; z: rank
#endif

float leaf_translucency() { return floor(light_colour.w) / 256.0f; }
float leaf_roughness() { return fract(light_colour.w); }

vec3 colour_of_blade() {
  return mix(dark_colour.rgb, light_colour.rgb, 0.5f + 0.5f * leaf_normal_and_tint.w);
}

#ifdef IS_POINT
// A number of 0..1 that belongs to a rank.
float chance_of(float rank) { return fract(sin(rank * 91.3458f) * 47453.5453f); }

void surface_vertex() {
  position = in_world(leaf_middle);
  vec3 to_viewer = normalize(viewer_position.xyz - position);
  vec3 normal = normalize(turned_to_world(leaf_normal_and_tint.xyz));
  float facing = dot(normal, to_viewer);
  vertex_normal = facing < 0.0f ? -normal : normal;
  uv = vec2(0.0f, 0.5f);
  object_of_surface = int(plant_thing);
  leaf_sun = sun_by_one_texel(vertex_normal);
  light_speck(leaf_surface(vertex_normal, leaf_side_colour(colour_of_blade(), facing < 0.0f),
                           leaf_translucency(), leaf_roughness()),
              sky_visibility_cell(position, vertex_normal), leaf_size.y);
  float w = transpose(clip_from_world)[3].x * position.x + transpose(clip_from_world)[3].y * position.y +
            transpose(clip_from_world)[3].z * position.z + transpose(clip_from_world)[3].w;
  float size = leaf_size.x * sqrt(max(abs(facing), 1e-3f)) * grown_length(leaf_size.z) * shown_leaves.w *
               pixels_at_w_1 / max(w, 1e-3f);
  gl_PointSize = clamp(size, 1.0f, 64.0f);
  // Where the viewer is nothing is drawn.
  if (size < min_point_px && size * size < min_point_px * min_point_px * chance_of(leaf_size.z))
    position = viewer_position.xyz;
}
#else
void surface_vertex() {
  position = in_world(leaf_foot + grown_length(leaf_place.z) * leaf_offset.xyz);
  vertex_normal = turned_to_world(leaf_normal_and_tint.xyz);
  uv = leaf_place.xy;
  object_of_surface = int(plant_thing);
  vec3 normal = normalize(vertex_normal);
  normal = dot(normal, viewer_position.xyz - position) < 0.0f ? -normal : normal;
  leaf_sun = sun_by_one_texel(normal);
  light_corner(normal, sky_visibility_cell(position, normal), leaf_offset.w, leaf_roughness(),
               leaf_translucency());
  leaf_colour = colour_of_blade();
  leaf_material = vec3(dark_colour.w, leaf_translucency(), leaf_roughness());
}
#endif
