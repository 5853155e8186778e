// The static things of a scene as they stood, so that an edit is found.
#pragma once

#include <array>

#include "base/bounds.h"
#include "scene/data/scene.h"

namespace parvis::crowd {

/// Remembers the things that `ground_of` takes for ground and obstacles.
class GroundWatch {
 public:
  /// The box around all that has come, gone, moved or changed its shape since the last call, at both places,
  /// with room for a body around it; empty: nothing has. The first call finds nothing.
  Bounds changes(const scene::Scene& scene);

 private:
  struct Thing {
    std::shared_ptr<const void> shape;  ///< null: it is not there, or moves by itself
    glm::mat4 world_from_shape{0.0f};
    Bounds bounds;  ///< in the world
  };
  std::array<std::vector<Thing>, 3> things_;  ///< objects, grown plants, captured trees
  bool has_looked_ = false;
};

}  // namespace parvis::crowd
