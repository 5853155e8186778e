// Where light goes on at a surface: directions are chosen lobe by lobe (coat, base, diffuse, through), about
// as often as the lobes of shading/surface.glsl send light there. Smooth lobes are mirrors.
#pragma once

#include <optional>

#include "graphics/reference/frame.h"
#include "graphics/shading/surface.h"

namespace parvis::reference {

class Scatter {
 public:
  /// `normal` of the surface and `to_viewer` lie on one side.
  Scatter(const shading::Surface& surface, glm::vec3 to_viewer);

  /// One sample of the BSDF.
  struct BsdfSample {
    glm::vec3 direction;
    glm::vec3 weight;  ///< BSDF times cosine, over pdf; mirrors: reflectance over the probability of the lobe
    float pdf;         ///< per steradian; 0: the one direction of a mirror
    float spread;      ///< radians by which the lobe widens a cone
  };
  /// Samples the BSDF by three uniform numbers in [0, 1). Nothing where the path ends: directions below the
  /// horizon, black surfaces.
  std::optional<BsdfSample> sample(float uniform, glm::vec2 uniforms) const;

  /// BRDF times cosine toward the viewer, without mirrors.
  glm::vec3 share(glm::vec3 to_light) const;
  /// Probability density with which `sample` chooses a direction, per steradian, without mirrors.
  float pdf(glm::vec3 direction) const;
  /// Are there lobes other than mirrors?
  bool spreads() const { return spread_chance_ > 0.0f; }

 private:
  struct Highlight {
    float alpha = 0.0f, chance = 0.0f;
    bool is_mirror = false;
  };
  BsdfSample mirror_sample(const Highlight& highlight, glm::vec3 share) const;
  std::optional<BsdfSample> spread_sample(glm::vec3 direction, float spread) const;
  glm::vec3 highlight_direction(const Highlight& highlight, glm::vec2 uniforms) const;
  float highlight_pdf(const Highlight& highlight, float n_dot_h) const;

  const shading::Surface& surface_;
  glm::vec3 to_viewer_;
  Frame frame_;
  float n_dot_v_;
  Highlight coat_, base_;
  float diffuse_chance_ = 0.0f, through_chance_ = 0.0f, spread_chance_ = 0.0f;
};

}  // namespace parvis::reference
