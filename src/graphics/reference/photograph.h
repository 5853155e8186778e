// A reference photograph by path tracing: radiance, depth and alpha, rendered tile by tile, resumable.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include "base/camera.h"
#include "base/image.h"
#include "base/result.h"
#include "graphics/reference/path_tracer.h"
#include "machines/processes.h"

namespace parvis::reference {

/// Sampling, checkpoint and interruption of a photograph.
struct PhotographOptions {
  int samples_per_pixel = 64;
  std::uint64_t seed = 1;
  PathOptions paths;
  std::filesystem::path checkpoint;  ///< file of finished tiles, the caller's to remove; empty: none
  bool replaces_checkpoint = false;  ///< tiles of other work in that file may be lost; else they are an error
  const std::atomic<bool>* is_interrupted = nullptr;  ///< when it turns true, no further tile is begun
  std::string progress = "photographing";
  machines::Processes processes = {};  ///< that divide the tiles among them; all take the same photographs
};

/// A finished photograph; the three images have the same size, top row first.
struct Photograph {
  ImageF radiance;         ///< linear RGB: unweighted mean of the samples, W/(m2 sr) before exposure
  Image8 alpha;            ///< fraction of the samples that hit the scene rather than the sky, 0..255
  ImageF depth_m;          ///< depth of the pixel's centre along the camera's axis; 0 for the sky
  std::uint64_t rays = 0;  ///< of all kinds and processes, in this run
  double seconds = 0.0;    ///< of this run
};

/// Takes the photograph. The same scene, camera and options give the same bits for any number of threads,
/// of any number of processes, with or without interruption. The photograph is complete in the first process,
/// which alone keeps a checkpoint. Errors: the checkpoint cannot be written; the work was interrupted
/// (finished tiles are in the checkpoint, and the same call resumes).
Result<Photograph> take_photograph(const RayScene& rays, const scene::Scene& scene,
                                   const shading::SkyLight& sky, const Camera& camera, int width, int height,
                                   const PhotographOptions& options);

}  // namespace parvis::reference
