// One material: render/gpu_scene.cpp fills the block and binds the textures.
layout(std140) uniform Material {
  vec4 material_base_colour;  // rgb, alpha
  vec4 material_emission;     // rgb; a: scale of the normal map
  vec4 material_layers;       // metallic, roughness, clear coat, its roughness
  vec4 material_texture_u;    // row of texture_from_mesh_uv; w: translucency
  vec4 material_texture_v;    // w: 1 where alpha cuts out
  float material_relief_m;    // depth of the normal texture's alpha 0
  float material_mirrors;     // 1: takes the scene's reflection method on things that do
  float material_ior;         // of solid glass
};
uniform sampler2D base_colour_texture;
uniform sampler2D normal_texture;
uniform sampler2D surface_texture;
uniform sampler2D emission_texture;

vec2 texture_coordinates(vec2 mesh_uv) {
  vec3 p = vec3(mesh_uv, 1.0f);
  return vec2(dot(material_texture_u.xyz, p), dot(material_texture_v.xyz, p));
}
