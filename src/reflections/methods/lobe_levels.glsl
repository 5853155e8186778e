// Levels of a cube map that are blurred for the lobes of rough mirrors: which level holds which roughness
// (Karis 2013, "Real Shading in Unreal Engine 4"), and the directions that a blurred texel is the mean of.

// `levels`: log2 of the texels per side. Below 0: the sharpest level is the nearest.
GLSL_FUNCTION float level_of_roughness(float levels, float roughness) {
  return levels - 1.0f + 1.2f * log2(max(roughness, 1e-3f));
}

// The roughness that a level is blurred for.
GLSL_FUNCTION float roughness_of_level(float levels, float level) {
  return min(exp2((level + 1.0f - levels) / 1.2f), 1.0f);
}

// Direction number `i` of `count` over the lobe about `normal`, which is the viewer's direction, too: half
// vectors of the GGX distribution. w: the solid angle that it stands for. It may point below the surface.
GLSL_FUNCTION vec4 lobe_sample(vec3 normal, float roughness, int i, int count) {
  float alpha = roughness * roughness;
  float u = (float(i) + 0.5f) / float(count);
  float phi = 6.28318531f * fract(float(i) * 0.618033989f);
  float cosine = sqrt((1.0f - u) / (1.0f + (alpha * alpha - 1.0f) * u));
  float sine = sqrt(max(0.0f, 1.0f - cosine * cosine));
  vec3 pole = abs(normal.z) < 0.9f ? vec3(0.0f, 0.0f, 1.0f) : vec3(1.0f, 0.0f, 0.0f);
  vec3 across = normalize(cross(pole, normal));
  vec3 along = cross(normal, across);
  vec3 half_vector = sine * cos(phi) * across + sine * sin(phi) * along + cosine * normal;
  float d = cosine * cosine * (alpha * alpha - 1.0f) + 1.0f;
  float density = alpha * alpha / (12.5663706f * d * d);  // of directions
  return vec4(reflect(-normal, half_vector), 1.0f / (density * float(count)));
}
