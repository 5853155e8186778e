// Cuts streets before their crossings. A large vehicle that turns sweeps over the last metres of adjacent
// streets; cut off, only these metres are shared with it, and the rest of the street is not.
#pragma once

#include <vector>

#include "scene/data/road_graph.h"

namespace parvis::traffic {

/// Role of a lane after cutting.
enum class LanePart { street, turn, first_metres, last_metres };

/// A road graph with its streets cut.
struct CutStreets {
  scene::RoadGraph roads;       ///< existing lanes keep their index; a cut one becomes its first metres
  std::vector<LanePart> parts;  ///< of each lane
};

/// Cuts `end_m` off both ends of every street of at least six times that length.
CutStreets cut_streets(const scene::RoadGraph& roads, float end_m);

}  // namespace parvis::traffic
