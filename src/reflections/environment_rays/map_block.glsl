// How the height field and the reference maps are laid out: the uniform block of map_uniforms.glsl, and in
// C++ the struct of its bytes.
UNIFORM_BLOCK(MapLayout) {
  vec4 height_grid;  // south-west corner, metres per cell, top level
  vec4 choice_grid;  // south-west corner, metres per cell
  vec2 height_cells;
  vec2 layer_size;  // texels per side, and of its border
};
