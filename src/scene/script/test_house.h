// The rooms of a scene, for tests of what they do together.
#pragma once

#include "formats/city_models/room.h"
#include "formats/gltf/room.h"
#include "formats/meshes/room.h"
#include "formats/terrain/room.h"
#include "graphics/light/room.h"
#include "life/traffic/room.h"
#include "scene/action/room.h"
#include "scene/roads/room.h"
#include "scene/script/room.h"

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
