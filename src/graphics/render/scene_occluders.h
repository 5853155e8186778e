// Occluders of a view: the static scene, and dynamic objects near the eye.
#pragma once

#include "graphics/render/gpu_scene.h"
#include "graphics/render/occlusion.h"

namespace parvis::render {

class SceneOccluders {
 public:
  SceneOccluders(const scene::Scene& scene, const GpuScene& gpu);
  /// Static things appeared, vanished or moved.
  void find_fixed(const scene::Scene& scene);
  /// The scene has more objects than before.
  void follow_objects(const scene::Scene& scene, const GpuScene& gpu) { keep_moving_shapes(scene, gpu); }
  /// Draws the occluders of a view; things of `gpu` as they were updated last.
  void draw(const View& view, const GpuScene& gpu);
  /// The culler of the view drawn last.
  const OcclusionCuller& culler() const { return culler_; }

 private:
  void keep_moving_shapes(const scene::Scene& scene, const GpuScene& gpu);

  OcclusionCuller culler_;
  std::vector<int> shape_of_part_;  ///< of the GPU scene's parts; -1: the part hides nothing while it moves
  std::vector<OcclusionCuller::PlacedShape> placed_shapes_;
};

}  // namespace parvis::render
