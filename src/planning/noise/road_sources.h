// What makes noise in a scene: patches of lanes, tram tracks and noise sources with their sound power.
#pragma once

#include <vector>

#include "life/propagation/site.h"
#include "planning/noise/traffic_count.h"
#include "scene/data/scene.h"

namespace parvis::noise {

/// A piece of a lane, of tram track or of a noise source: a source at its middle stands for it.
struct SourcePatch {
  propagation::Place middle{0.0};
  glm::dvec3 half{0.0};    ///< from the middle to the patch's end, metres
  int lane = 0;            ///< index in the scene's road graph; -1: it is of trams, or of a noise source
  double height_m = 0.05;  ///< over the ground; CNOSSOS-EU, 2.2.1: all vehicles; negative: its own height

  /// Length, metres.
  double length_m() const { return 2.0 * glm::length(half); }
};

/// Energies of the sound power of a patch (relative to 1 pW), by octave, for each period.
using PatchPower = std::array<propagation::Octaves, periods>;

/// The sources of a scene: roads, trams at their headways (the same at all hours), noise sources.
struct RoadSources {
  std::vector<SourcePatch> patches;
  std::vector<PatchPower> power;  ///< of each patch
  bool is_driven = false;         ///< the vehicles of traffic count, the same at all hours, not trafficCount
  int lanes_without_figures = 0;  ///< that are silent: no trafficCount names their road
  bool has_trams = false;         ///< then levels are indicative: no standard has plain trams
};

/// Patches of `patch_m` at most. Errors: trafficCount or traffic that counts on no road; neither of them,
/// where nothing else makes noise.
Result<RoadSources> road_sources(const scene::Scene& scene, double patch_m);

/// The power of the same patches where so many times as many vehicles drive on each road; trams keep their
/// headways, and noise sources their power.
std::vector<PatchPower> multiplied(const RoadSources& sources, double factor);

}  // namespace parvis::noise
