// A patch of a reflector that a shader draws where the view shows it: a uniform block, and in C++ the struct
// of its bytes.
UNIFORM_BLOCK(PatchView) {
  mat4 clip_from_reflector;
  vec4 viewer_in_reflector;
  vec4 mirror_colour;  // reflectance of what the surface mirrors
};
