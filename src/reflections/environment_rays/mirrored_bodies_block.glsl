// Dynamic objects that mirror rays may hit: the uniform block, and in C++ the struct of its bytes.
struct MirroredBody {
  vec4 box_from_world[3];  // rows: metres from the box's middle along its edges
  vec4 half_size_m;        // w: the field
  uvec4 near;              // one byte per body near it: index plus 1, nearest first; 0 ends the list
};
const int max_mirrored_bodies = 200;
const int field_columns = 2;  // fields side by side in their texture

UNIFORM_BLOCK(MirroredBodies) { MirroredBody mirrored_bodies[max_mirrored_bodies]; };
