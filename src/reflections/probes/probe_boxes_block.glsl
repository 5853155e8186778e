// The two probes about a reflector, each in its box: a uniform block, and in C++ the struct of its bytes.
struct ProbeBox {
  vec4 map_centre;
  vec4 box_centre;
  vec4 box_half_size;
  vec4 box_heading;  // cosine and sine
};

UNIFORM_BLOCK(ProbeBoxes) {
  ProbeBox boxes[2];
  float second_share;
};
