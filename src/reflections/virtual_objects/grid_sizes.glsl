// Widths of the textures of virtual grids, and what is stored of each corner that was searched. Constant
// powers of two, for software renderers divide whole numbers one by one. GLSL that is C++, too.

const int table_width = 1024;
const int results_width = 64;
const int result_layers = 3;       // image, reflection point, normal there
const int grid_header_texels = 3;  // before the corners: origin, cells per metre, count of cells
const int numbers_per_texel = 4;   // of corners, by their place in the box
