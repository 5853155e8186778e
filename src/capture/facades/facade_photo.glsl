// A photograph as facade_lookup.glsl sees it: a row of the table of photographs. GLSL that is C++, too.
struct FacadePhoto {
  vec4 row_x;  // of pixel_from_facade: pixel = (row_x, row_y) . (p, 1) / (row_z . (p, 1))
  vec4 row_y;
  vec4 row_z;
  vec4 centre;  // of projection; w: focal length, pixels
  vec4 size;    // width, height, pixels; the first of its depths / 4096, and the rest
  vec4 scale;   // balance of sRGB values
  vec4 offset;
};
