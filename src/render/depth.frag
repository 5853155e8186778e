#include "render/cutout.glsl"

void main() { discard_holes(); }
