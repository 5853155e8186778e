// A body of solid glass through which vertices are shown: a uniform block, and in C++ the struct of its
// bytes.
#include "reflections/refraction/refraction_limits.glsl"

UNIFORM_BLOCK(Refraction) {
  mat4 refraction_rays[refraction_start_count];
  float glass_ior;
  int passed_by_light;  // how many foci
};
