// The rooms of a scene, for tests of what they do together.
#pragma once

#include "formats/city_models/city_formats.h"
#include "formats/gltf/gltf_formats.h"
#include "formats/meshes/mesh_nodes.h"
#include "formats/terrain/terrain_formats.h"
#include "graphics/light/light_nodes.h"
#include "life/traffic/traffic_nodes.h"
#include "scene/action/action_nodes.h"
#include "scene/roads/road_nodes.h"
#include "scene/script/script_nodes.h"

namespace parvis::scene {

inline House test_house() {
  House house;
  for (const auto furnish : {furnish_script, furnish_gltf, furnish_city_models, furnish_terrain,
                             furnish_meshes, furnish_roads, traffic::furnish, furnish_light, action::furnish})
    furnish(house);
  return house;
}

}  // namespace parvis::scene
