// The bodies near a viewer, and which of them shade each cell of the ground (body_shade.glsl): the uniform
// block, and in C++ the struct of its bytes.
UNIFORM_BLOCK(Bodies) {
  vec4 body_grid;
  uvec4 body_cells[body_cells_per_side * body_cells_per_side / 4];
  Body bodies[max_bodies];
};
