#include "scene/script/placement.h"

#include <glm/gtc/matrix_transform.hpp>

#include "scene/script/attribute.h"

namespace parvis::scene {

using namespace attribute;

std::vector<AttributeSchema> placement_attributes() {
  return {vec3("position", "where its origin stands in its parent").in("m").by_default("0 0 0").live(),
          angle("heading_deg", "turn about the vertical, clockwise from above")
              .in("degrees")
              .by_default("0")
              .live(),
          number("scale", "size relative to the file's").between(1e-6, 1e6).by_default("1").live()};
}

AttributeSchema visible_attribute() {
  return flag("visible", "whether it is to be seen at first").by_default("1").live();
}

glm::mat4 turned(float heading) {
  return glm::rotate(glm::mat4(1.0f), -heading, glm::vec3(0.0f, 0.0f, 1.0f));
}

glm::mat4 placement(const Node& node) {
  return glm::translate(glm::mat4(1.0f), node.vec3("position")) * turned(node.angle("heading_deg")) *
         glm::scale(glm::mat4(1.0f), glm::vec3(float(node.number("scale"))));
}

}  // namespace parvis::scene
