// Ground truth: the scene traced with the renderer's own shading functions and shadow maps, with exact mirror
// reflections.
#pragma once

#include "base/camera.h"
#include "base/image.h"
#include "graphics/reference/ray_scene.h"
#include "graphics/shading/drawn_light.h"
#include "graphics/shading/sky.h"

namespace parvis::reference {

/// A part of a picture, in pixels from its top left.
struct PixelWindow {
  int x = 0, y = 0, width = 0, height = 0;
};

struct TraceOptions {
  int samples_per_pixel = 16;  ///< rounded up to a square number
  std::uint64_t seed = 1;
  /// The renderer's; null: exact shadow rays, a sky open everywhere, and moving things that hide none of it.
  const shading::DrawnLight* drawn_light = nullptr;
  bool mirrors_see_themselves = true;  ///< else a reflection passes through its own object
  int mirror_bounces = 1;              ///< after as many mirrors, mirror-like parts show the sky
  PixelWindow window;                  ///< traces this part alone, which is then the whole result; empty: all
  std::string progress = "tracing";    ///< what the progress bar says
};

struct TracedPicture {
  ImageF radiance;         ///< linear RGB, mean of the samples by shading::sample_weight
  Image8 mirror_mask;      ///< a channel: share of the pixel's samples that fell on mirror-like parts, 0..255
  std::uint64_t rays = 0;  ///< of all kinds
  double seconds = 0.0;
};

/// The object that each pixel's centre shows, counted from 1; 0: the sky.
using ObjectPicture = BasicImage<std::uint32_t>;
ObjectPicture trace_objects(const RayScene& rays, const Camera& camera, int width, int height);

/// Traces one picture. Solid glass shows what its refracted rays hit, with Fresnel's share at each surface
/// and reflections inside; in mirrors, and on objects that take no reflections, the sky straight through it.
/// It casts no shadow. Mirror-like parts of objects that take reflections show what their mirror rays hit,
/// shaded by the same recipe; after `mirror_bounces` mirrors they reflect the sky, as all
/// other surfaces do. The same options
/// give the same picture for any number of threads.
TracedPicture trace_picture(const RayScene& rays, const scene::Scene& scene, const shading::SkyLight& sky,
                            const Camera& camera, int width, int height, const TraceOptions& options);

}  // namespace parvis::reference
