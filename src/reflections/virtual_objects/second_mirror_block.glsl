// The mirror that a first one shows: a uniform block, and in C++ the struct of its bytes.
UNIFORM_BLOCK(SecondMirror) {
  mat4 clip_of_view;  // from the world
  mat4 world_from_second;
  vec4 viewer_in_world;
  vec4 second_middle;  // in the world
};
