// The roads of a scene as sources of noise: patches of lanes with their sound power.
#pragma once

#include <vector>

#include "life/propagation/site.h"
#include "planning/noise/traffic_count.h"
#include "scene/data/scene.h"

namespace parvis::noise {

/// A piece of a lane: a source at its middle, 5 cm above the road, stands for it.
struct SourcePatch {
  propagation::Place middle{0.0};
  glm::dvec3 half{0.0};  ///< from the middle to the patch's end, metres
  int lane = 0;          ///< index in the scene's road graph

  /// Length, metres.
  double length_m() const { return 2.0 * glm::length(half); }
};

/// Energies of the sound power of a patch (relative to 1 pW), by octave, for each period.
using PatchPower = std::array<propagation::Octaves, periods>;

/// The sources of a scene.
struct RoadSources {
  std::vector<SourcePatch> patches;
  std::vector<PatchPower> power;  ///< of each patch
  bool is_counted = false;        ///< by trafficCount; else by the vehicles of traffic, the same at all hours
  int lanes_without_figures = 0;  ///< that are silent: no trafficCount names their road
};

/// Patches of `patch_m` at most. Errors: no roads; neither trafficCount nor traffic.
Result<RoadSources> road_sources(const scene::Scene& scene, double patch_m);

/// The power of the same patches with the figures of another state of the scene, whose flows are multiplied
/// by `factor`. Errors: the lanes are others; as of road_sources.
Result<std::vector<PatchPower>> power_of(const scene::Scene& scene, const RoadSources& sources,
                                         double factor);

}  // namespace parvis::noise
