// The depth behind which crowns hide everything (crown_cover.h), the same for each square of pixels.
uniform highp sampler2D shown;
uniform vec2 squares_per_pixel;

void main() { gl_FragDepth = texelFetch(shown, ivec2(gl_FragCoord.xy * squares_per_pixel), 0).r; }
