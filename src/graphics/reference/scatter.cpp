#include "graphics/reference/scatter.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "base/colour.h"

namespace parvis::reference {
namespace {

using glm::vec2, glm::vec3;

constexpr float diffuse_spread =
    0.2f;  // of a cone after a diffuse bounce: textures are looked up coarser there

/// A direction about the z axis with a density proportional to the cosine.
vec3 cosine_direction(vec2 uniforms) {
  const float radius = std::sqrt(uniforms.x), turn = 2.0f * glm::pi<float>() * uniforms.y;
  return {radius * std::cos(turn), radius * std::sin(turn), std::sqrt(std::max(0.0f, 1.0f - uniforms.x))};
}

/// A half vector of the GGX normals that `to_viewer` sees, both about the z axis (Dupuy and Benyoub 2023,
/// Sampling Visible GGX Normals with Spherical Caps).
vec3 visible_half_vector(vec3 to_viewer, float alpha, vec2 uniforms) {
  const vec3 v = glm::normalize(vec3(alpha * to_viewer.x, alpha * to_viewer.y, to_viewer.z));
  const float turn = 2.0f * glm::pi<float>() * uniforms.x, z = (1.0f - uniforms.y) * (1.0f + v.z) - v.z;
  const float radius = std::sqrt(std::clamp(1.0f - z * z, 0.0f, 1.0f));
  const vec3 h = vec3(radius * std::cos(turn), radius * std::sin(turn), z) + v;
  return glm::normalize(vec3(alpha * h.x, alpha * h.y, std::max(h.z, 1e-6f)));
}

}  // namespace

Scatter::Scatter(const shading::Surface& surface, vec3 to_viewer)
    : surface_(surface),
      to_viewer_(to_viewer),
      frame_(surface.normal),
      n_dot_v_(std::max(glm::dot(surface.normal, to_viewer), 1e-4f)) {
  const float coat = shading::fresnel_of_coat(surface, n_dot_v_);
  const vec3 reflectance = shading::base_reflectance(surface, n_dot_v_);
  const float diffuse =
      (1.0f - surface.metallic) * luminance((vec3(1.0f) - reflectance) * surface.base_colour);
  const float base_light = (1.0f - coat) * luminance(reflectance), diffuse_light = (1.0f - coat) * diffuse;
  const float through_light =
      (1.0f - surface.metallic) * surface.translucency * luminance(surface.base_colour);
  const float sum = coat + base_light + diffuse_light + through_light;
  if (!(sum > 0.0f)) return;
  coat_ = {shading::ggx_alpha(surface.clear_coat_roughness), coat / sum,
           surface.clear_coat_roughness < shading::min_roughness};
  base_ = {shading::ggx_alpha(surface.roughness), base_light / sum,
           surface.roughness < shading::min_roughness};
  diffuse_chance_ = diffuse_light / sum;
  through_chance_ = through_light / sum;
  spread_chance_ = diffuse_chance_ + through_chance_ + (coat_.is_mirror ? 0.0f : coat_.chance) +
                   (base_.is_mirror ? 0.0f : base_.chance);
}

vec3 Scatter::share(vec3 to_light) const {
  return shading::scattered_share(surface_, to_viewer_, to_light, base_.is_mirror ? 0.0f : 1.0f,
                                  coat_.is_mirror ? 0.0f : 1.0f);
}

vec3 Scatter::highlight_direction(const Highlight& highlight, vec2 uniforms) const {
  const vec3 v = frame_.from_world(to_viewer_);
  return glm::reflect(-to_viewer_, frame_.in_world(visible_half_vector(v, highlight.alpha, uniforms)));
}

/// Smith's masking of the viewer times the distribution, over four cosines that cancel.
float Scatter::highlight_pdf(const Highlight& highlight, float n_dot_h) const {
  const float a2 = highlight.alpha * highlight.alpha;
  return shading::ggx_distribution(highlight.alpha, n_dot_h) /
         (2.0f * (n_dot_v_ + std::sqrt(a2 + (1.0f - a2) * n_dot_v_ * n_dot_v_)));
}

float Scatter::pdf(vec3 direction) const {
  const float cosine = glm::dot(surface_.normal, direction);
  if (cosine <= 0.0f) return through_chance_ * -cosine / glm::pi<float>();
  float sum = diffuse_chance_ * cosine / glm::pi<float>();
  const float n_dot_h =
      std::clamp(glm::dot(surface_.normal, glm::normalize(to_viewer_ + direction)), 0.0f, 1.0f);
  if (!base_.is_mirror && base_.chance > 0.0f) sum += base_.chance * highlight_pdf(base_, n_dot_h);
  if (!coat_.is_mirror && coat_.chance > 0.0f) sum += coat_.chance * highlight_pdf(coat_, n_dot_h);
  return sum;
}

Scatter::BsdfSample Scatter::mirror_sample(const Highlight& highlight, vec3 share) const {
  return {glm::reflect(-to_viewer_, surface_.normal), share / highlight.chance, 0.0f, 0.0f};
}

std::optional<Scatter::BsdfSample> Scatter::spread_sample(vec3 direction, float spread) const {
  const float chosen = pdf(direction);
  if (!(chosen > 0.0f)) return std::nullopt;
  return BsdfSample{direction, share(direction) / chosen, chosen, spread};
}

std::optional<Scatter::BsdfSample> Scatter::sample(float uniform, vec2 uniforms) const {
  const auto falls_to = [&](float chance) {
    return chance > 0.0f && uniform < chance ? true : (uniform -= chance, false);
  };
  const auto highlight_sample = [&](const Highlight& highlight) -> std::optional<BsdfSample> {
    const vec3 direction = highlight_direction(highlight, uniforms);
    if (glm::dot(surface_.normal, direction) <= 0.0f) return std::nullopt;  // the rough surface keeps it
    return spread_sample(direction, 0.5f * highlight.alpha);
  };
  const float coat = shading::fresnel_of_coat(surface_, n_dot_v_);
  if (falls_to(coat_.chance))
    return coat_.is_mirror ? mirror_sample(coat_, vec3(coat)) : highlight_sample(coat_);
  if (falls_to(base_.chance)) {
    const vec3 f0 = shading::specular_f0(surface_);
    const vec3 fresnel = f0 + (vec3(1.0f) - f0) * shading::schlick_weight(n_dot_v_);
    return base_.is_mirror ? mirror_sample(base_, (1.0f - coat) * fresnel) : highlight_sample(base_);
  }
  const vec3 local = cosine_direction(uniforms);
  if (falls_to(diffuse_chance_)) return spread_sample(frame_.in_world(local), diffuse_spread);
  if (falls_to(through_chance_)) return spread_sample(-frame_.in_world(local), diffuse_spread);
  return std::nullopt;
}

}  // namespace parvis::reference
