// A captured facade in the scene: a uniform block, and in C++ the struct of its bytes.
UNIFORM_BLOCK(Facade) {
  mat4 world_from_facade;
  mat4 facade_from_world;
  float radiance_of_exposed;  // radiance that the display shows as exposed 1
  float kept_of_shadows;      // share of its light that is left in shadow; 1: it receives none
  float facade_units_log2;    // of the facade's frame in a metre, log2
  int facade_thing;
};
