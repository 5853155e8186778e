// A point of a reflector.
struct SurfacePoint {
  vec3 position;
  vec3 normal;  // unit length, to the side that reflects
  float kind;   // of what is there (map_window.glsl)
};
