// A crown of leaves for tests.
#pragma once

#include "base/random.h"
#include "scene/data/test_scene.h"

namespace parvis::scene {

inline constexpr float leaf_m = 0.3f, crown_m = 3.0f;

/// A ball of square leaves, twig by twig.
inline Mesh crown(int leaves) {
  constexpr int leaves_of_twig = 12;
  Random random(5);
  const auto about = [&](float radius) {
    glm::vec3 place(radius);
    while (glm::length(place) > radius)
      place = {random.uniform(-radius, radius), random.uniform(-radius, radius),
               random.uniform(-radius, radius)};
    return place;
  };
  Mesh mesh;
  glm::vec3 twig(0.0f);
  for (int i = 0; i < leaves; ++i) {
    if (i % leaves_of_twig == 0) twig = about(crown_m);
    const glm::vec3 middle = twig + about(0.5f), normal = glm::normalize(about(1.0f));
    const glm::vec3 along = 0.5f * leaf_m * glm::normalize(glm::cross(normal, about(1.0f)));
    const glm::vec3 aside = glm::cross(normal, along);
    append(mesh, quad(middle - along - aside, middle + along - aside, middle + along + aside,
                      middle - along + aside));
  }
  return mesh;
}

/// A leaf's material, the same on both sides.
inline Material leaf_material(glm::vec3 colour, float translucency) {
  Material leaf;
  leaf.base_colour = colour, leaf.translucency = translucency;
  leaf.roughness = 0.6f;
  leaf.alpha_mode = Alpha::cutout;
  leaf.is_double_sided = true;
  return leaf;
}

}  // namespace parvis::scene
