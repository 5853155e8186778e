// Streets cut before their crossings. A large vehicle that turns swings across the last metres of the streets
// beside its own; cut off, these metres are shared with it, and the rest of the street is not.
#pragma once

#include <vector>

#include "scene/data/road_graph.h"

namespace parvis::traffic {

enum class LanePart { street, turn, first_metres, last_metres };

struct CutStreets {
  scene::RoadGraph roads;       ///< lanes that were there keep their index; a cut one is now its first metres
  std::vector<LanePart> parts;  ///< of each lane
};

/// Cuts `end_m` off both ends of each street that is long enough to wait on between them.
CutStreets cut_streets(const scene::RoadGraph& roads, float end_m);

}  // namespace parvis::traffic
