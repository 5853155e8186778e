#include "planning/plan_drawing/plan_nodes.h"

#include <glm/gtc/matrix_transform.hpp>

#include "scene/script/attribute.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"

namespace parvis::plan_drawing {

void add_plan_attributes(scene::NodeSchema& schema) {
  const std::vector<scene::AttributeSchema> placement = scene::placement_attributes();
  schema.attributes.insert(schema.attributes.end(), placement.begin(), placement.end());
  schema.attributes.push_back(
      scene::attribute::number("height",
                               "above its position: a little above the ground the plan lies under the "
                               "place, above the roofs it lies over it")
          .in("m")
          .between(-1000.0, 1000.0)
          .by_default("0.02")
          .live());
  schema.attributes.push_back(scene::visible_attribute());
}

glm::mat4 world_from_plan(const scene::Node& node, const glm::dvec3& origin, scene::SceneBuilder& builder) {
  constexpr double far_m = 50'000.0;  // floats end at millimetres there, and no city is so large
  glm::dvec3 offset(0.0);
  if (origin != glm::dvec3(0.0)) {
    if (builder.scene.origin == glm::dvec3(0.0)) builder.scene.origin = origin;
    offset = glm::dvec3(glm::dvec2(origin - builder.scene.origin), 0.0);
    if (glm::length(offset) > far_m) {
      builder.warn(error_at(node.where_of("file"),
                            "this plan lies {:.0f} km from the scene's first georeferenced model; their "
                            "coordinate systems may differ. It is put beside it instead",
                            glm::length(offset) / 1000.0));
      offset = glm::dvec3(0.0);
    }
  }
  const glm::vec3 above(0.0f, 0.0f, float(node.number("height")));
  return builder.world_from_parent() * glm::translate(glm::mat4(1.0f), above) * scene::placement(node) *
         glm::translate(glm::mat4(1.0f), glm::vec3(offset));
}

}  // namespace parvis::plan_drawing
