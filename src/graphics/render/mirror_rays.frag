// Where mirror-like surfaces stand and what way their rays leave, for methods that work a pixel's reflection out once.
#define WRITES_RAYS
#include "graphics/render/surface_body.glsl"
