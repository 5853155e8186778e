// One material: its uniform block and its textures, which gpu_scene.cpp binds.
#include "graphics/render/material_block.glsl"

uniform sampler2D base_colour_texture;
uniform sampler2D normal_texture;
uniform sampler2D surface_texture;
uniform sampler2D emission_texture;
uniform sampler2D occlusion_texture;

vec2 texture_coordinates(vec2 mesh_uv) {
  vec3 p = vec3(mesh_uv, 1.0f);
  return vec2(dot(material_texture_u.xyz, p), dot(material_texture_v.xyz, p));
}
