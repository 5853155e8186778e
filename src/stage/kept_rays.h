// The ray tracer's hierarchy of a running scene, built once on a thread of its own and kept between the
// pictures that are traced while the scene rests.
#pragma once

#include <chrono>
#include <future>
#include <memory>

#include "graphics/reference/ray_scene.h"
#include "scene/data/scene.h"

namespace parvis::stage {

/// A ray tracer that is kept between pictures of a scene; used from one thread at a time.
class KeptRays {
 public:
  /// A hierarchy of a scene as it stands now.
  struct Moment {
    const reference::RayScene* rays;
    const scene::Scene* scene;  ///< a copy, which `rays` refers to
  };

  /// The hierarchy of `scene`, brought up to where it stands now. A new one is built where there is none of
  /// its objects; nothing: it is not ready after `patience`. Then it is built on: ask again. What is returned
  /// holds until the next call.
  std::optional<Moment> of(const scene::Scene& scene, std::chrono::milliseconds patience);

 private:
  struct Kept {
    scene::Scene scene;  ///< its meshes stay where they are in memory while their content follows the scene
    reference::RayScene rays;
    explicit Kept(const scene::Scene& source) : scene(source), rays(scene) {}
  };

  std::unique_ptr<Kept> kept_;
  std::future<std::unique_ptr<Kept>> building_;
};

}  // namespace parvis::stage
