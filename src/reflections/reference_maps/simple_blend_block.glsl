// The reference maps of simple_blend.glsl: its uniform block, and in C++ the struct of its bytes.
UNIFORM_BLOCK(BlendedMaps) {
  vec2 layer_size;  // texels per side, and of its border
  vec2 map_pair;
};
