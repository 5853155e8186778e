// The sRGB encoding and its inverse (IEC 61966-2-1), for shaders; base/colour.h has them for C++.

vec3 linear_of_srgb(vec3 srgb) {
  vec3 s = clamp(srgb, vec3(0.0f), vec3(1.0f));
  return mix(pow((s + 0.055f) / 1.055f, vec3(2.4f)), s / 12.92f, vec3(lessThanEqual(s, vec3(0.04045f))));
}

vec3 srgb_of_linear(vec3 linear) {
  return mix(1.055f * pow(linear, vec3(1.0f / 2.4f)) - 0.055f, 12.92f * linear,
             vec3(lessThanEqual(linear, vec3(0.0031308f))));
}
