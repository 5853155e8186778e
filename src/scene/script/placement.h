// Where a node stands in the frame of its parent: position, heading, scale.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/script/node.h"

namespace parvis::scene {

/// position=, heading_deg=, scale=
std::vector<AttributeSchema> placement_attributes();

/// visible=
AttributeSchema visible_attribute();

/// parent_from_node of a node with placement_attributes().
glm::mat4 placement(const Node& node);

/// Turns by `heading` (radians, clockwise from above).
glm::mat4 turned(float heading);

}  // namespace parvis::scene
