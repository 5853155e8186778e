// The light of mirror rays, carried on by a pixel: to where a surface covers less than a pixel's middle.
uniform highp sampler2DArray ray_directions;
uniform highp sampler2DArray base_light;
uniform highp sampler2DArray coat_light;
layout(location = 0) out vec4 base_radiance;  // alpha: there is one
layout(location = 1) out vec3 coat_radiance;

void main() {
  ivec2 here = ivec2(gl_FragCoord.xy), last = textureSize(ray_directions, 0).xy - ivec2(1);
  vec4 base_sum = vec4(0.0f);
  vec3 coat_sum = vec3(0.0f);
  for (int i = 0; i < 4; ++i) {
    ivec2 step = i < 2 ? ivec2(2 * i - 1, 0) : ivec2(0, 2 * i - 5);
    ivec3 there = ivec3(clamp(here + step, ivec2(0), last), 0);
    if (texelFetch(ray_directions, there, 0).w == 0.0f) continue;
    base_sum += texelFetch(base_light, there, 0);
    coat_sum += texelFetch(coat_light, there, 0).rgb;
  }
  float count = max(base_sum.a, 1.0f);
  base_radiance = base_sum / count;
  coat_radiance = coat_sum / count;
}
