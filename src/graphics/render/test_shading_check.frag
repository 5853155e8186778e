// For tests: what the shared shading functions give on the GPU. Each pixel is a case, numbered from the
// bottom left; render/shading_check.glsl makes its surface and light out of the number, here and in C++
// alike.
#include "graphics/shading/surface.glsl"
#include "graphics/shading/sky.glsl"
#include "graphics/shading/lighting.glsl"
#include "graphics/shading/sky_visibility.glsl"
#include "graphics/shading/tone_curve.glsl"
#include "graphics/render/test_shading_check.glsl"

out vec4 result;

void main() { result = vec4(checked_shading(floor(gl_FragCoord.x), floor(gl_FragCoord.y)), 1.0f); }
