// Starting rays of a search through glass, and how many images of a point are drawn. GLSL that is C++, too.

const int refraction_start_count = 37;
const int refraction_layers = 3;
