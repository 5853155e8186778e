// Round walls: towers, silos, rotundas, bow fronts, which files have as many narrow facets.
#pragma once

#include <vector>

#include "places/dressing/wall_panels.h"

namespace parvis::dressing {

/// Finds the runs of `panels`, which are those of `walls`: three or more neighbouring facets of one building
/// that turn by 1 to 30 degrees from one to the next, each up to 6 m wide, with feet and eaves of the same
/// height. Two are neighbours where nothing else meets them at the edge between them: the houses of a bent
/// row, which have party walls there, stay apart. The facets of a run get one foot and one height of eaves.
void find_runs(std::vector<WallPanel>& panels, const std::vector<ModelTriangle>& walls);

/// A number of bays for a run. Where its facets are even, there are whole bays on each or whole facets in
/// each, so that windows stand in the middle of facets.
struct RunBays {
  float count;
  float shift;  ///< of the bays along the run, in bays: their middles come to those of facets
};
/// Bays about as wide as `bay_m`, one or more.
RunBays bays_of(const WallRun& run, float bay_m);

}  // namespace parvis::dressing
