// How local maps are drawn from reference maps: a uniform block, and in C++ the struct of its bytes.
UNIFORM_BLOCK(PictureLayout) {
  vec2 layer_size;    // texels per side, and of its border
  vec2 picture_size;  // of all local maps, texels
  vec2 near_far;      // of the cube faces that are drawn over the map
  float cell_m;       // of the height field
};
