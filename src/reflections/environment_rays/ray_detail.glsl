// Levels of detail of one reflector's mirror rays. GLSL that is C++, too.

const int nearest_map = 0;  // no ray: direct lookup in the nearest map, at the distance stored there
const int one_map = 1;      // a ray against the static scene, looked up in the best map
const int all_detail = 2;
const int detail_count = 3;
