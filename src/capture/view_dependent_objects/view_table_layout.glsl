// How the texture of viewpoints lays out its table. GLSL that is C++, too.

const int view_table_px = 1024;  // texels in a row; a constant power of two divides at no cost
