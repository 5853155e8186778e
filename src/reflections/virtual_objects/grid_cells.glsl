// Where a vertex lies among the cells of a virtual grid: the same to the last bit wherever it is asked, so
// that a vertex on a cell's border finds its corners on both sides.

// In cells from the grid's origin.
GLSL_FUNCTION vec3 position_in_cells(vec3 vertex, vec3 origin, vec3 cells_per_m) {
  return (vertex - origin) * cells_per_m;
}

// The cell that contains such a position, of `count` along each axis.
GLSL_FUNCTION ivec3 cell_around(vec3 in_cells, ivec3 count) {
  return clamp(ivec3(floor(in_cells)), ivec3(0), count - 1);
}

// Index of a corner among all of the grid's box; x changes fastest.
GLSL_FUNCTION int index_in_box(ivec3 corner, ivec3 count) {
  return (corner.z * (count.y + 1) + corner.y) * (count.x + 1) + corner.x;
}
