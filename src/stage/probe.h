// What a pixel of a picture shows: the point, the object and its kind.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "base/camera.h"
#include "scene/data/scene.h"

namespace parvis::stage {

/// The nearest visible surface behind a pixel.
struct ProbedPoint {
  glm::vec3 position_in_world;
  float distance_m;  ///< from the eye
  int object;        ///< index in the scene; beyond them, of what rooms draw by themselves
  std::string name;  ///< of the object
  std::string kind;  ///< of its surface there: the material's name
};

/// Looks through the middle of `pixel`, which counts from the top left of a picture of that size. Nothing
/// where the sky is seen, or outside the picture.
std::optional<ProbedPoint> probe(const scene::Scene& scene, const Camera& camera, glm::ivec2 size,
                                 glm::ivec2 pixel);

/// A sentence for people: metres, object, kind; with map coordinates where the scene has them.
std::string to_string(const std::optional<ProbedPoint>& point, const scene::Scene& scene);

}  // namespace parvis::stage
