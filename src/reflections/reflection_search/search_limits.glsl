// How many starting points a patch has, and which end of a search is accepted. GLSL that is C++, too.

const int search_start_count = 16;
const int starts_beside = 8;  // further ones near each of those
const int all_start_count = search_start_count * (1 + starts_beside);
const float found_angle = 0.0035f;  // radians, 0.2 degrees: a point with a larger error is rejected
