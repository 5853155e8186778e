#include "graphics/render/cutout.glsl"

void main() { discard_holes(); }
