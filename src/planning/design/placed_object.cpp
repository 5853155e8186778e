#include "planning/design/placed_object.h"

#include <cmath>

namespace parvis::design {
namespace {

/// Maps from the object's frame (x to the right of its front, y ahead) to the plan.
glm::dvec2 in_plan(glm::dvec2 centre, glm::dvec2 right_and_ahead, double heading_deg) {
  const double heading = glm::radians(heading_deg);
  const glm::dvec2 ahead(std::sin(heading), std::cos(heading)), right(ahead.y, -ahead.x);
  return centre + right_and_ahead.x * right + right_and_ahead.y * ahead;
}

}  // namespace

std::vector<glm::dvec2> rectangle_outline(glm::dvec2 centre, glm::dvec2 size_m, double heading_deg) {
  std::vector<glm::dvec2> outline;
  for (const glm::dvec2 corner : {glm::dvec2(-1, 1), glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1)})
    outline.push_back(in_plan(centre, 0.5 * corner * size_m, heading_deg));
  return outline;
}

std::vector<glm::dvec2> ellipse_outline(glm::dvec2 centre, glm::dvec2 size_m, double heading_deg,
                                        int corners) {
  std::vector<glm::dvec2> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * glm::radians(180.0) * double(i) / double(corners);
    outline.push_back(
        in_plan(centre, 0.5 * size_m * glm::dvec2(std::cos(angle), std::sin(angle)), heading_deg));
  }
  return outline;
}

std::vector<PlacedObject> labelled_in(Language language, std::vector<PlacedObject> objects) {
  if (language == Language::french)
    for (PlacedObject& object : objects)
      object.label = object.label_fr.empty() ? in_language(object.label, language) : object.label_fr;
  return objects;
}

double signed_area_m2(const std::vector<glm::dvec2>& outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return 0.5 * twice;
}

}  // namespace parvis::design
