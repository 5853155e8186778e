// Of test_quads.h, in GLSL and C++: more light the higher and the farther east the viewer stands.
GLSL_FUNCTION vec3 emission_toward(vec3 to_viewer) {
  return vec3(0.6f + 0.5f * to_viewer.x, 0.2f, 0.6f + 0.5f * to_viewer.z);
}
