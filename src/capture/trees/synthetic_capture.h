// Captures with truth: path-traced views of a tree of known shape with exact alpha (reference/path_tracer.h).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/kept_parts.h"
#include "base/result.h"
#include "capture/trees/tree_view.h"
#include "scene/data/scene.h"

namespace parvis::trees {

/// The sun of a capture.
struct CaptureLight {
  float sun_azimuth_deg = 150.0f;  ///< clockwise from north (+y)
  float sun_height_deg = 48.0f;
};

/// Exposure of the photographs of a capture: a leaf in the sun is then about 0.7 in sRGB.
inline constexpr float capture_exposure = 0.9f;

/// A scene of the model alone, under that sun and a plain sky.
scene::Scene capture_scene(const scene::Model& model, const CaptureLight& light);

/// How views are traced.
struct CaptureOptions {
  int width = 800, height = 800;  ///< pixels
  int samples_per_pixel = 16;
  int bounces = 1;  ///< surfaces that scatter light on its path; 1: sun and sky directly
  std::uint64_t seed = 1;
};

/// Cameras of a ring of `count` round the model, between 2 and 26 degrees above its middle, which see all of
/// it.
std::vector<Camera> capture_cameras(const Bounds& tree, int count);
/// Cameras of the same band at places of their own, random.
std::vector<Camera> held_out_cameras(const Bounds& tree, int count, std::uint64_t seed);

/// The view of one camera: pure foreground and coverage, both from the same samples. Colour is sRGB at
/// `exposure`.
TreeView photograph_tree(const scene::Scene& scene, const Camera& camera, std::string name, float exposure,
                         const CaptureOptions& options);
/// All cameras, one after the other, at capture_exposure; names are NAME_000 ...
std::vector<TreeView> photograph_tree(const scene::Scene& scene, std::span<const Camera> cameras,
                                      const std::string& name, const CaptureOptions& options);
/// The same. Each photograph is kept under its name when it is taken, and found again by the same call:
/// `checkpoint` is the caller's to remove. Error: one cannot be kept; those that were stay.
Result<std::vector<TreeView>> photograph_tree(const scene::Scene& scene, std::span<const Camera> cameras,
                                              const std::string& name, const CaptureOptions& options,
                                              const KeptParts& checkpoint);

/// The hash of all that a photograph depends on. `shown_scene`: scene_key of what it shows.
std::uint64_t photograph_key(std::uint64_t shown_scene, const Camera& camera, float exposure,
                             const CaptureOptions& options);

}  // namespace parvis::trees
