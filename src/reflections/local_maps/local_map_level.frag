// One level of the local maps out of the finer one: four texels to one.
uniform highp sampler2D finer;

in vec2 picture_uv;
out vec4 radiance;

void main() { radiance = vec4(textureLod(finer, picture_uv, 0.0f).rgb, 1.0f); }
