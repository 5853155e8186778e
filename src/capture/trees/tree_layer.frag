// Billboards that were blended by themselves (tree_layer.h), premultiplied.
uniform highp sampler2D shown;
out vec4 radiance;

void main() { radiance = texelFetch(shown, ivec2(gl_FragCoord.xy), 0); }
