#include "graphics/reference/relief.h"

namespace parvis::reference {
namespace {

using namespace shading;  // vec2, cross and the like, which the shared file takes for granted

/// Gives the shared functions the depths that a shader has in its sampler.
struct Lookup {
  const MipTexture& texture;
  float texels;

  float relief_depth(vec2 uv) const { return 1.0f - texture.sample(uv, texels).w; }

#include "graphics/shading/relief.glsl"

  vec2 uv_to_floor(const TextureFrame& edges, vec3 normal, vec3 direction, float depth_m) {
    return uv_through_relief(edges, normal, direction, depth_m);
  }
};

}  // namespace

Relief::Relief(const MipTexture& normal_texture, float texels, float depth_m, float width_m,
               const TextureFrame& edges, vec3 normal, vec3 direction, vec2 uv)
    : texels_(texels), edges_(edges), normal_(normal), hit_(uv, 0.0f) {
  Lookup lookup{normal_texture, texels};
  depth_m_ = depth_m * lookup.relief_share(width_m, depth_m);
  if (depth_m_ <= 0.0f) return;
  texture_ = &normal_texture;
  hit_ = lookup.relief_hit(uv, lookup.uv_to_floor(edges, normal, direction, depth_m_));
}

float Relief::light_from(vec3 to_light) const {
  if (is_flat() || hit_.z <= 0.0f || dot(to_light, normal_) <= 0.0f) return 1.0f;
  Lookup lookup{*texture_, texels_};
  return lookup.relief_light(hit_, lookup.uv_to_floor(edges_, normal_, to_light, depth_m_));
}

}  // namespace parvis::reference
