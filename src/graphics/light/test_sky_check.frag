// For tests and the bench: the sky models on the GPU, one direction of the input texture per pixel. CIE XYZ.
#include "graphics/light/preetham.glsl"

uniform highp sampler2D directions;
uniform highp sampler2DArray sky_view_table;
uniform vec3 to_sun;
uniform float turbidity;  // of Preetham's model; 0: the atmosphere's table
out vec4 result;

vec3 sky_view_texel(int layer, ivec2 place) { return texelFetch(sky_view_table, ivec3(place, layer), 0).rgb; }

#include "graphics/light/haze.glsl"
#include "graphics/light/sky_view_layout.glsl"
#include "graphics/light/sky_view.glsl"

void main() {
  vec3 direction = texelFetch(directions, ivec2(gl_FragCoord.xy), 0).xyz;
  vec3 radiance = sky_view_radiance(direction, to_sun);
  result = vec4(turbidity > 0.0f ? preetham_xyz(direction, to_sun, turbidity) : radiance, 1.0f);
}
