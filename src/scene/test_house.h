// The rooms of a scene, for tests of what they do together.
#pragma once

#include "life/traffic/traffic_nodes.h"
#include "scene/action/action_nodes.h"
#include "scene/city_formats.h"
#include "scene/gltf_formats.h"
#include "scene/light_nodes.h"
#include "scene/mesh_nodes.h"
#include "scene/road_nodes.h"
#include "scene/script_nodes.h"
#include "scene/terrain_formats.h"

namespace parvis::scene {

inline House test_house() {
  House house;
  for (const auto furnish : {furnish_script, furnish_gltf, furnish_city_models, furnish_terrain,
                             furnish_meshes, furnish_roads, traffic::furnish, furnish_light, action::furnish})
    furnish(house);
  return house;
}

}  // namespace parvis::scene
