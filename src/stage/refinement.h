// Refinement at rest: while view and scene stand still, the ray tracer's picture of the view grows on threads
// of its own, a sample of each pixel at a time, and takes the place of the drawn one.
#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <thread>

#include "graphics/reference/tracer.h"
#include "scene/data/scene.h"
#include "stage/kept_rays.h"

namespace parvis::stage {

/// The picture of one view at one moment. What it shows is copied when it begins; the light that the renderer
/// drew it in is not: the renderer begins no frame before the refinement is gone.
class Refinement {
 public:
  static constexpr int max_samples = 256;  ///< per pixel; then the picture counts as finished

  /// Begins. `rays`: of the scenes that were refined before; no other refinement uses them at the same time.
  /// `bounces`: after as many mirrors, mirrors show the sky.
  Refinement(KeptRays& rays, const scene::Scene& scene, const shading::SkyLight& sky,
             shading::DrawnLight light, const Camera& camera, int width, int height, int bounces);
  Refinement(const Refinement&) = delete;
  /// Waits for the row of the picture that is traced, not for a hierarchy that is being built.
  ~Refinement();

  /// The picture so far, linear RGB: the mean of `samples()` samples of each pixel; nothing where it has no
  /// more of them than when it was taken last. From another thread than the tracer's.
  std::optional<ImageF> take();
  /// Samples of each pixel in the picture that was taken last or could be now.
  int samples() const { return samples_; }

 private:
  void run();
  void add(const ImageF& sample);

  KeptRays& rays_;
  scene::Scene scene_;
  const shading::SkyLight& sky_;
  shading::DrawnLight light_;
  Camera camera_;
  int width_, height_, bounces_;

  std::mutex mutex_;  ///< of the sums
  ImageF sum_, weights_;
  bool is_new_ = false;
  std::atomic<int> samples_ = 0;
  std::atomic<bool> is_interrupted_ = false;
  std::jthread thread_;  ///< last: it uses all of the above
};

}  // namespace parvis::stage
