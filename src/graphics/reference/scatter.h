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

  struct Way {
    glm::vec3 direction;
    glm::vec3 weight;  ///< share of the light from there, over the chance of going there
    float density;     ///< per steradian; 0: a mirror's one direction
    float spread;      ///< radians by which the lobe widens a cone
  };
  /// Nothing where light ends: what is chosen below the horizon, black surfaces.
  std::optional<Way> way(float uniform, glm::vec2 uniforms) const;

  /// BRDF times cosine toward the viewer, without mirrors.
  glm::vec3 share(glm::vec3 to_light) const;
  /// How densely `way` chooses near a direction, per steradian, mirrors left out.
  float density(glm::vec3 direction) const;
  /// Are there lobes other than mirrors?
  bool spreads() const { return spread_chance_ > 0.0f; }

 private:
  struct Highlight {
    float alpha = 0.0f, chance = 0.0f;
    bool is_mirror = false;
  };
  Way mirror_way(const Highlight& highlight, glm::vec3 share) const;
  std::optional<Way> spread_way(glm::vec3 direction, float spread) const;
  glm::vec3 highlight_direction(const Highlight& highlight, glm::vec2 uniforms) const;
  float highlight_density(const Highlight& highlight, float n_dot_h) const;

  const shading::Surface& surface_;
  glm::vec3 to_viewer_;
  Frame frame_;
  float n_dot_v_;
  Highlight coat_, base_;
  float diffuse_chance_ = 0.0f, through_chance_ = 0.0f, spread_chance_ = 0.0f;
};

}  // namespace parvis::reference
