// How the texture of lamps lays out its table. GLSL that is C++, too.

const int lamp_table_px = 256;  // texels in a row
const int texels_per_lamp = 4;
