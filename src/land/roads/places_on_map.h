// Traffic lights and bus stops that a map of a place has: nodes of its model, which readers of maps add.
#pragma once

#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "scene/data/scene.h"

namespace parvis::scene {

/// The name of the node of a model that stands where the map has a traffic light.
inline constexpr std::string_view map_signal_node = "traffic signals";

/// The name of the node of a model that stands where the map has a bus stop.
inline constexpr std::string_view map_bus_stop_node = "bus stop";

/// Places in the world of an object's nodes of one of these names.
inline std::vector<glm::vec3> places_on_map(const Object& object, std::string_view node) {
  std::vector<glm::vec3> places;
  const std::vector<glm::mat4> model_from_node = rest_pose(*object.model);
  for (std::size_t n = 0; n < object.model->nodes.size(); ++n)
    if (object.model->nodes[n].name == node)
      places.emplace_back(object.world_from_model * model_from_node[n][3]);
  return places;
}

}  // namespace parvis::scene
