// The bodies that move near the viewer, and their shade: block at binding 2, filled by renderer.cpp.
#include "graphics/shading/body_shade.glsl"
#include "graphics/shading/body_shade_block.glsl"

#include "graphics/shading/body_shade_lookup.glsl"
