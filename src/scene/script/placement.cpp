#include "scene/script/placement.h"

#include <glm/gtc/matrix_transform.hpp>

namespace parvis::scene {

std::vector<AttributeSchema> placement_attributes() {
  return {{.name = "position",
           .type = AttributeType::vec3,
           .help = "where its origin stands in its parent",
           .fallback = "0 0 0",
           .unit = "m",
           .is_live = true},
          {.name = "heading_deg",
           .type = AttributeType::angle,
           .help = "turn about the vertical, clockwise from above",
           .fallback = "0",
           .unit = "degrees",
           .is_live = true},
          {.name = "scale",
           .type = AttributeType::number,
           .help = "size relative to the file's",
           .fallback = "1",
           .minimum = 1e-6,
           .maximum = 1e6,
           .is_live = true}};
}

AttributeSchema visible_attribute() {
  return {.name = "visible",
          .type = AttributeType::flag,
          .help = "whether it is to be seen at first",
          .fallback = "1",
          .is_live = true};
}

glm::mat4 turned(float heading) {
  return glm::rotate(glm::mat4(1.0f), -heading, glm::vec3(0.0f, 0.0f, 1.0f));
}

glm::mat4 placement(const Node& node) {
  return glm::translate(glm::mat4(1.0f), node.vec3("position")) * turned(node.angle("heading_deg")) *
         glm::scale(glm::mat4(1.0f), glm::vec3(float(node.number("scale"))));
}

}  // namespace parvis::scene
