// People who walk: simple figures for streets and for what cars mirror.
#pragma once

#include <vector>

#include "scene/data/model.h"

namespace parvis::city {

/// Metres a second at which a walker's feet stay where they touch the ground.
inline constexpr float walking_speed_m_s = 1.35f;

struct WalkerClothes {
  const char* name;
  glm::vec3 jacket{0.3f}, trousers{0.2f}, hair{0.1f}, skin{0.5f};  ///< linear
};

/// About 1,000 triangles, 1.75 m tall; x forward, y left, z up, feet at z = 0. Limbs are nodes; the animation
/// "walk" swings them for ever.
scene::Model make_walker(const WalkerClothes& clothes);

/// One of each kind of clothes, named "walker_blue" and so on.
std::vector<scene::Model> city_walkers();

}  // namespace parvis::city
