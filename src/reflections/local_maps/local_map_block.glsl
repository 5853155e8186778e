// The local map of the drawn body: the uniform block of local_environment_maps.frag, and in C++ the struct of
// its bytes.
UNIFORM_BLOCK(LocalMap) {
  vec4 local_map;     // south-west corner in texels, texels per side of a tile; 0: there is none
  vec2 picture_size;  // of all local maps
  float local_border;
};
