// The surfaces of a scene for those who place things: what lies below a pointer, and what objects rest on.
#pragma once

#include <memory>
#include <optional>

#include "graphics/reference/ray_scene.h"
#include "planning/design/session.h"

namespace parvis::design {

/// Rays against a scene as it is at each question; the scene outlives it.
class SceneSurfaces {
 public:
  explicit SceneSurfaces(const scene::Scene& scene) : scene_(scene) {}

  /// A place on a surface.
  struct Place {
    glm::dvec3 position;
    glm::vec3 normal;  ///< unit, on the side of the ray
    int object;        ///< index in the scene; beyond them, of what rooms draw by themselves
  };
  /// The first surface along a ray, without the objects that are named; none: the sky.
  std::optional<Place> first_along(reference::Ray ray, const Names& without = {});
  /// The same for those who walk, who ask many times in each frame: of the scene as it was a while ago, at
  /// most 200 questions.
  std::optional<Place> first_along_lately(const reference::Ray& ray);

  /// Height of what objects rest on: of all that lies there, the highest within 1.2 m of the lowest: ground,
  /// kerb, steps, table tops, but no roofs. What rooms draw by themselves (plants) and backdrops do not
  /// count. 0 where there is nothing.
  double resting_height(glm::dvec2 at, const Names& without = {});

 private:
  const reference::RayScene& rays();
  std::optional<Place> first(const reference::RayScene& rays, reference::Ray ray, const Names& without) const;

  const scene::Scene& scene_;
  std::unique_ptr<reference::RayScene> rays_;  ///< made when it is first asked for
  int asked_ = 0;                              ///< since it was brought up to date
};

/// `resting_height` of surfaces that the function keeps.
Session::Heights resting_heights(const scene::Scene& scene);

}  // namespace parvis::design
