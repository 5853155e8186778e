// One material: the uniform block, and in C++ the struct that gpu_scene.cpp fills.
UNIFORM_BLOCK(Material) {
  vec4 material_base_colour;  // rgb; alpha, of cutouts scaled so that they are visible from 0.5 on
  vec4 material_emission;     // rgb; a: scale of the normal map
  vec4 material_layers;       // metallic, roughness, clear coat, its roughness
  vec4 material_texture_u;    // row of texture_from_mesh_uv; w: translucency
  vec4 material_texture_v;    // w: 1 where alpha cuts out
  float material_relief_m;    // depth of the normal texture's alpha 0
  float material_mirrors;     // 1: takes the scene's reflection method on things that do
  float material_ior;         // of solid glass
  float material_occlusion;   // strength of the map of ambient occlusion
  // Of materials whose textures do not all lie as the base colour does: rows of each one's transform; w of
  // the first: 1 where it takes the second texture coordinates.
  vec4 material_normal_u;
  vec4 material_normal_v;
  vec4 material_surface_u;
  vec4 material_surface_v;
  vec4 material_emission_u;
  vec4 material_emission_v;
  vec4 material_occlusion_u;
  vec4 material_occlusion_v;
};
