// Irradiance at the vertices of objects that are lit there (scene/data/vertex_irradiance.h), one texel each,
// in rows of 1024.
uniform highp sampler2D vertex_light_texture;

vec3 vertex_light_at(int texel) {
  return texelFetch(vertex_light_texture, ivec2(texel & 1023, texel >> 10), 0).rgb;
}
