// The configuration of the paper itself: a local map per car, out of 54 reference maps along all roads.
#pragma once

#include "base/house.h"
#include "bench/report.h"
#include "scene/data/scene.h"

namespace parvis::bench {

/// The city with traffic on all of its roads, where its script keeps it to the streets about a crossing.
scene::Scene driven_everywhere(const scene::Scene& city);

/// `paper_flip_ratio` and `paper_cost_ratio`: local maps of 128 pixels out of 54 reference maps spread evenly
/// over all 8 km of road, over re-rendered cube maps, in a city whose traffic drives everywhere, while it
/// drives. The cost ratio is that of re-rendering, with levels of detail or without, whichever costs less,
/// over local maps with them: of eight to twelve cars from above, as in the paper's table 1, and as
/// `paper_cost_ratio_near` in the views that are judged.
Status measure_paper_configuration(const House& house, const scene::Scene& city, bool is_quick,
                                   Report& report);

}  // namespace parvis::bench
