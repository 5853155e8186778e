// The parts of the light through glass that are drawn one after another. GLSL that is C++, too.

const int behind_glass = 0;  // the light that hits the glass where the ray leaves it first
const int let_through = 1;   // the share of it that gets to the viewer
const int from_inside = 2;   // what gets there after reflections inside
const int all_light = 3;
