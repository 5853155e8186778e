// The vertex of a surface in the world, for any shader that then says where a picture shows it.
#include "graphics/render/frame.glsl"
#include "graphics/render/surface_outputs.glsl"
// Not within IS_LEAF: a file that has been included there would be missing where another one includes it
// again.
#include "graphics/render/body_lookup.glsl"
#include "graphics/render/leaf_light.glsl"
#include "graphics/render/material.glsl"
#include "graphics/render/sun_lookup.glsl"

layout(location = 0) in vec3 mesh_position;
layout(location = 1) in vec3 mesh_normal;
layout(location = 2) in vec2 mesh_uv;
layout(location = 3) in vec4 world_from_mesh_row0;
layout(location = 4) in vec4 world_from_mesh_row1;
layout(location = 5) in vec4 world_from_mesh_row2;
layout(location = 6) in uint object;
#ifdef HAS_COLOURS
layout(location = 10) in vec4 mesh_colour;
#endif
#ifdef HAS_OWN_MAPPINGS
layout(location = 11) in vec2 mesh_second_uv;
#endif
#ifdef IS_LEAF
layout(location = 9) in float mesh_openness;  // share of the sky that the plant itself leaves open
#endif
#ifdef HAS_VERTEX_LIGHT
layout(location = 8) in ivec2 first_light;  // of vertex 0 of the buffer, on both sides
#include "graphics/render/vertex_light_lookup.glsl"
#endif

#include "graphics/render/object_flags.glsl"

#ifdef IS_LEAF
// In the mean of its texture.
float leaf_roughness() {
#ifdef HAS_SURFACE_MAP
  return material_layers.y * textureLod(surface_texture, vec2(0.5f), 16.0f).g;
#else
  return material_layers.y;
#endif
}
#endif

void surface_vertex() {
  vec4 p = vec4(mesh_position, 1.0f);
  position = vec3(dot(world_from_mesh_row0, p), dot(world_from_mesh_row1, p), dot(world_from_mesh_row2, p));
  // Normals follow the cofactors of the transform, which need no inverse.
  vec3 c0 = vec3(world_from_mesh_row0.x, world_from_mesh_row1.x, world_from_mesh_row2.x);
  vec3 c1 = vec3(world_from_mesh_row0.y, world_from_mesh_row1.y, world_from_mesh_row2.y);
  vec3 c2 = vec3(world_from_mesh_row0.z, world_from_mesh_row1.z, world_from_mesh_row2.z);
  vertex_normal = mat3(cross(c1, c2), cross(c2, c0), cross(c0, c1)) * mesh_normal;
  uv = mesh_uv;
#ifdef HAS_OWN_MAPPINGS
  second_uv = mesh_second_uv;
#endif
#ifdef HAS_COLOURS
  vertex_colour = mesh_colour;
#endif
  bool receives = (object & no_shadow_received) == 0u;
  int number = int(object & ~no_shadow_received);
#ifdef IS_LEAF
  vec3 normal = normalize(vertex_normal);
  normal = dot(normal, viewer_position.xyz - position) < 0.0f ? -normal : normal;
  leaf_sun = visible_sun(position, normal);
  light_corner(
      normal,
      shaded_cell(sky_visibility_cell(position, normal), sky_share_beside_bodies(position, normal, number)),
      mesh_openness, leaf_roughness(), material_texture_u.w);
#endif
#ifdef HAS_VERTEX_LIGHT
  vertex_light = vertex_light_at(first_light.x + gl_VertexID);
  vertex_light_behind = vertex_light_at(first_light.y + gl_VertexID);
#endif
  object_of_surface = receives ? number : ~number;
}
