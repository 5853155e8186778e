// The rooms of a scene, for tests of what they do together.
#pragma once

#include "base/house.h"
#include "room_list.h"

namespace parvis::scene {

inline House test_house() {
  House house;
  for (const auto furnish :
       {script::furnish, gltf::furnish, city_models::furnish, terrain::furnish, meshes::furnish,
        roads::furnish, traffic::furnish, light::furnish, action::furnish})
    furnish(house);
  return house;
}

}  // namespace parvis::scene
