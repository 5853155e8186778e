// Widths of the textures of virtual grids, and what is stored of each corner that was searched. Constant
// powers of two, for software renderers divide whole numbers one by one. GLSL that is C++, too.

const int table_width = 1024;
const int results_width = 64;
const int result_layers = 3;  // image, reflection point, normal there
