// The shade of all bodies near a point. Needs shading/body_shade.glsl, and from the host, which
// shading/body_shade.h fills:
//   vec4 body_grid;          xy: south-west corner of a square of cells
//   uvec4 body_cells[];      one word per cell, in it one byte per body near the cell: its index plus 1
//   Body bodies[max_bodies];

// Share 0..1 of its sky that bodies leave to a surface; `object` does not shade itself.
GLSL_FUNCTION float sky_share_beside_bodies(vec3 position, vec3 normal, int object) {
  vec2 place = (vec2(position.x, position.y) - vec2(body_grid.x, body_grid.y)) / body_cell_m;
  float side = float(body_cells_per_side);
  if (min(place.x, place.y) < 0.0f || max(place.x, place.y) >= side) return 1.0f;
  int cell = int(place.y) * body_cells_per_side + int(place.x);
  uint word = body_cells[cell / 4][cell % 4];
  float share = 1.0f;
  do {  // the condition comes last: see lamps_lookup.glsl
    int number = int(word & 255u) - 1;
    Body body = bodies[max(number, 0)];
    if (number >= 0 && int(body.half_size_m.w) != object + 1)
      share *= sky_share_beside(body, position, normal);
    word >>= 8u;
  } while (word != 0u);
  return share;
}
