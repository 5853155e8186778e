// For tests: what the shared shading functions give on the GPU. Each pixel is a case, numbered from the bottom left;
// render/shading_check.glsl makes its surface and light out of the number, here and in C++ alike.
#include "shading/surface.glsl"
#include "shading/sky.glsl"
#include "shading/lighting.glsl"
#include "shading/sky_visibility.glsl"
#include "shading/tone_curve.glsl"
#include "render/shading_check.glsl"

out vec4 result;

void main() { result = vec4(checked_shading(floor(gl_FragCoord.x), floor(gl_FragCoord.y)), 1.0f); }
