// A cube map blurred for the roughnesses of the tiles: half vectors of the GGX distribution about the
// direction, which is normal and view at once (Karis 2013), each looked up as wide as its share of the lobe
// (Colbert and Krivanek 2007).
#include "graphics/shading/octahedral.glsl"
#include "reflections/reference_maps/map_levels.glsl"

uniform highp samplerCube cube;
uniform vec2 layer_size;
in vec2 screen_uv;
out vec4 radiance;

const int samples = 256;

// Points spread evenly over the unit square (Hammersley).
vec2 spread_point(int i) {
  uint bits = uint(i);
  bits = (bits << 16u) | (bits >> 16u);
  bits = ((bits & 0x55555555u) << 1u) | ((bits & 0xAAAAAAAAu) >> 1u);
  bits = ((bits & 0x33333333u) << 2u) | ((bits & 0xCCCCCCCCu) >> 2u);
  bits = ((bits & 0x0F0F0F0Fu) << 4u) | ((bits & 0xF0F0F0F0u) >> 4u);
  bits = ((bits & 0x00FF00FFu) << 8u) | ((bits & 0xFF00FF00u) >> 8u);
  return vec2((float(i) + 0.5f) / float(samples), float(bits) * 2.3283064e-10f);
}

void main() {
  float tile = min(floor(screen_uv.x * gloss_tile_count), gloss_tile_count - 1.0f);
  vec2 uv = vec2(screen_uv.x * gloss_tile_count - tile, screen_uv.y);
  vec3 normal = layer_direction(uv, gloss_side, gloss_border);
  float roughness = gloss_of_tile(tile);
  float alpha = roughness * roughness;
  vec3 across =
      normalize(cross(abs(normal.z) < 0.9f ? vec3(0.0f, 0.0f, 1.0f) : vec3(1.0f, 0.0f, 0.0f), normal));
  vec3 along = cross(normal, across);
  float face_texels = float(textureSize(cube, 0).x);
  vec3 sum = vec3(0.0f);
  float weights = 0.0f;
  for (int i = 0; i < samples; ++i) {
    vec2 u = spread_point(i);
    float cosine = sqrt((1.0f - u.x) / (1.0f + (alpha * alpha - 1.0f) * u.x));
    float sine = sqrt(max(0.0f, 1.0f - cosine * cosine));
    float phi = 6.28318531f * u.y;
    vec3 h = sine * cos(phi) * across + sine * sin(phi) * along + cosine * normal;
    vec3 direction = reflect(-normal, h);
    float n_dot_l = dot(normal, direction);
    if (n_dot_l <= 0.0f) continue;
    float d = cosine * cosine * (alpha * alpha - 1.0f) + 1.0f;
    float density = alpha * alpha / (3.14159265f * d * d) / 4.0f;  // of directions
    float solid_angle = 1.0f / (density * float(samples));
    float texels = sqrt(solid_angle * 6.0f / 12.5663706f) * face_texels;
    sum += textureLod(cube, direction, log2(max(texels, 1.0f)) + 0.5f).rgb;
    weights += 1.0f;
  }
  radiance = vec4(sum / max(weights, 1.0f), 1.0f);
}
