// A body of solid glass as glass_light.frag draws it: a uniform block, and in C++ the struct of its bytes.
UNIFORM_BLOCK(GlassLight) {
  vec4 glass_absorption;      // of a unit of the reflector's frame; w: index of refraction
  float surroundings_levels;  // below 0: none, the sky stands for them
  int shown_part;             // see glass_light_part.glsl
};
