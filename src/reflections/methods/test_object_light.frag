// Of mirror_picture_test.cpp: light of one colour along the mirror rays of an object.
uniform highp sampler2DArray ray_directions;
uniform int ray_layer, reflecting_object;
uniform vec3 object_light;
layout(location = 0) out vec4 base_radiance;
layout(location = 1) out vec3 coat_radiance;

void main() {
  if (int(texelFetch(ray_directions, ivec3(ivec2(gl_FragCoord.xy), ray_layer), 0).w) != reflecting_object + 1)
    discard;
  base_radiance = vec4(object_light, 1.0f);
  coat_radiance = vec3(0.0f);
}
