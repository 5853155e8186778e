// Ground truth: the scene traced with the renderer's own shading functions and shadow maps, with exact mirror
// reflections.
#pragma once

#include <atomic>
#include <optional>
#include <span>

#include "base/camera.h"
#include "base/image.h"
#include "graphics/reference/ray_scene.h"
#include "graphics/shading/drawn_light.h"
#include "graphics/shading/sky.h"

namespace parvis::machines {
class Processes;
}

namespace parvis::reference {

/// A rectangle of an image in pixels, from the top left.
struct PixelWindow {
  int x = 0, y = 0, width = 0, height = 0;
};

/// Sampling and light of a ground truth image.
struct TraceOptions {
  int samples_per_pixel = 16;  ///< rounded up to a square number
  std::uint64_t seed = 1;
  /// Shadow maps and sky visibility of the renderer. Null: exact shadow rays, a fully visible sky, and no
  /// occlusion of the sky by dynamic objects.
  const shading::DrawnLight* drawn_light = nullptr;
  bool mirrors_see_themselves = true;  ///< else a reflection passes through its own object
  int mirror_bounces = 1;              ///< after as many mirrors, mirror-like parts show the sky
  PixelWindow window;                  ///< traces this part alone, which is then the whole result; empty: all
  /// Traces this sample of each pixel alone: pictures of all of them, weighted by shading::sample_weight,
  /// have the mean of the whole picture.
  std::optional<int> only_sample;
  std::string progress = "tracing";  ///< what the progress bar says; empty: there is none
  /// When it turns true no further row is begun, and the rest of the picture stays black; null: never.
  const std::atomic<bool>* is_interrupted = nullptr;
  /// That divide the rows among them; null: this one alone. All of them call trace_picture; the picture is
  /// complete in the first one. Not owned.
  const machines::Processes* processes = nullptr;
};

/// A ground truth image of the window's size, top row first.
struct TracedPicture {
  ImageF radiance;         ///< linear RGB, mean of the samples by shading::sample_weight
  Image8 mirror_mask;      ///< a channel: share of the pixel's samples that fell on mirror-like parts, 0..255
  std::uint64_t rays = 0;  ///< of all kinds
  double seconds = 0.0;
};

/// The object that each pixel's centre shows, counted from 1; 0: the sky.
using ObjectPicture = BasicImage<std::uint32_t>;
/// Traces one ray through each pixel's centre: the ground truth of the renderer's picking view.
ObjectPicture trace_objects(const RayScene& rays, const Camera& camera, int width, int height);

/// Traces one image. Solid glass is traced with Fresnel reflectance at each surface and internal reflections;
/// seen in mirrors, and on objects that take no reflections, it shows the sky straight through instead. Glass
/// casts no shadow. Mirror-like parts of objects that take reflections show the surfaces that their mirror
/// rays hit, shaded in the same way; after `mirror_bounces` mirrors they reflect the sky, as all other
/// surfaces do. The result does not depend on the number of threads.
TracedPicture trace_picture(const RayScene& rays, const scene::Scene& scene, const shading::SkyLight& sky,
                            const Camera& camera, int width, int height, const TraceOptions& options);

/// Rays for a rough base layer, for each sample of the pixel.
inline constexpr int lobe_samples = 4;

/// Pixels of a square of this side send their rays for a rough base in directions that together cover its
/// lobe evenly: their mean has less noise than that of random ones. The second is that of a base that
/// reflects little, which may be averaged over more pixels.
inline constexpr int mirror_tile_px = 5, weak_mirror_tile_px = 9;

/// A pixel of a drawn picture that shows a mirror-like surface.
struct MirrorPixel {
  int x, y;            ///< in the picture: the same pixel takes the same directions of a lobe in each frame
  int object;          ///< index in the scene
  glm::vec3 position;  ///< that was drawn, in the world; a coarser mesh may have been drawn than rays hit
  glm::vec2 offset_px{0.0f};                                    ///< of the sample from it, across the view
  int base_rays = lobe_samples, weak_base_rays = lobe_samples;  ///< weak: of a base that reflects little
};

/// Light that a mirror-like surface reflects, each over its own lobe. Linear radiance.
struct MirrorLight {
  glm::vec3 base;  ///< what the base layer mirrors
  glm::vec3 coat;  ///< what the clear coat mirrors
  // By trace_mirrors alone:
  float sharp_share = 0.0f;    ///< of the surface's light that is a sharp mirror image
  bool has_weak_base = false;  ///< the base reflects little
};

/// Light mirrored by the mirror-like surfaces in these pixels, as in trace_picture, one sample each: a ray
/// for the coat, and as many as the pixel asks for a rough base. `eye`: of the picture; `spread`: width of a
/// pixel at one metre. `light` has one entry per pixel: none where rays find no such surface near `position`.
void trace_mirrors(const RayScene& rays, const scene::Scene& scene, const shading::SkyLight& sky,
                   glm::vec3 eye, float spread, std::span<const MirrorPixel> pixels,
                   const TraceOptions& options, std::span<std::optional<MirrorLight>> light);

}  // namespace parvis::reference
