// Pedestrians: simple figures for streets and for reflections in cars.
#pragma once

#include <vector>

#include "scene/data/model.h"

namespace parvis::city {

/// Walking speed at which the feet of the animation do not slide, metres per second.
inline constexpr float walking_speed_m_s = 1.35f;

/// Name and colours of a pedestrian.
struct WalkerClothes {
  const char* name;
  glm::vec3 jacket{0.3f}, trousers{0.2f}, hair{0.1f}, skin{0.5f};  ///< linear
};

/// A pedestrian of about 1,000 triangles, 1.75 m tall; x forward, y left, z up, feet at z = 0. Limbs are
/// nodes, swung by the looping animation "walk".
scene::Model make_walker(const WalkerClothes& clothes);

/// One pedestrian for each set of clothes, named "walker_blue" and so on.
std::vector<scene::Model> city_walkers();

}  // namespace parvis::city
