// Does a reference map see a point? Meyer and Loscos 2003, section 4.3: not where it saw something nearer.
// Heights are known to a cell and distances to a share of themselves, so what lies a little behind still
// counts, less and less.

const float mirror_reach_m = 1000.0f;  // of a mirror ray: what lies beyond is sky

// What a distance may be off.
GLSL_FUNCTION float slack_m(float distance_m, float cell_m) { return 0.02f * distance_m + 0.75f * cell_m; }

// From 0 (something hides the point) to 1. `seen_m`: what the map has in the point's direction; `distance_m`:
// the point's own distance from the map; `cell_m`: of the heightfield that the point was found in.
GLSL_FUNCTION float validity(float seen_m, float distance_m, float cell_m) {
  return clamp(2.0f - (distance_m - seen_m) / slack_m(distance_m, cell_m), 0.0f, 1.0f);
}
