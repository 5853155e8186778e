// A whole photograph by path tracing: light, depth and alpha, tile by tile, resumable.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include "base/camera.h"
#include "base/image.h"
#include "base/result.h"
#include "graphics/reference/path_tracer.h"

namespace parvis::reference {

struct PhotographOptions {
  int samples_per_pixel = 64;
  std::uint64_t seed = 1;
  PathOptions paths;
  std::filesystem::path checkpoint;  ///< file of finished tiles, the caller's to remove; empty: none
  const std::atomic<bool>* is_interrupted = nullptr;  ///< when it turns true, no further tile is begun
  std::string progress = "photographing";
};

struct Photograph {
  ImageF radiance;         ///< linear RGB: the plain mean of the samples
  Image8 alpha;            ///< share of the samples that meet the scene rather than the sky, 0..255
  ImageF depth_m;          ///< of what the pixel's centre sees, along the camera's axis; 0: the sky
  std::uint64_t rays = 0;  ///< of all kinds, in this run
  double seconds = 0.0;    ///< of this run
};

/// Takes the photograph. The same scene, camera and options give the same bits for any number of threads, and
/// whether or not work was interrupted. Errors: the checkpoint cannot be written; the work was interrupted
/// (then finished tiles lie in the checkpoint, and the same call goes on).
Result<Photograph> take_photograph(const RayScene& rays, const scene::Scene& scene,
                                   const shading::SkyLight& sky, const Camera& camera, int width, int height,
                                   const PhotographOptions& options);

}  // namespace parvis::reference
