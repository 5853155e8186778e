// A view-dependent object in the scene, and the piece of it that is drawn: a uniform block, and in C++ the
// struct of its bytes.
UNIFORM_BLOCK(ViewDependentObject) {
  mat4 world_from_object;
  mat4 object_from_world;
  float radiance_of_exposed;  // radiance that the display shows as exposed 1
  float kept_of_shadows;      // share of its light that is left in shadow; 1: it receives none
  float lit_luminance;        // of the object in the sun, exposed; 0: not known
  int thing;
  int first_entry, view_count, pass_count, first_triangle;
};
