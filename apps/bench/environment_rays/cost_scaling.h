// What the cost of reflections follows: their pixels, not the number of bodies nor the size of the city.
#pragma once

#include "base/house.h"
#include "bench/report.h"
#include "reflections/methods/settings.h"
#include "scene/data/scene.h"

namespace parvis::bench {

/// `cost_ratio_100_over_1` and `pixel_ns`: a car in the street, and in its place a hundred of the same model
/// that cover as much of the picture, with the reflections of both in full detail. Costs are per reflective
/// pixel. `cost_100_flip_mem_over_none` says that the hundred reflect, and re-rendered maps are the control.
Status measure_body_count(const House& house, const scene::Scene& city, const methods::Settings& reflection,
                          int repeats, Report& report);

/// `city_10km2_cost_over_1km2` and `city_10km2_flip_over_1km2`: the same views of the same cars, where the
/// city goes on over ten times the area with ten times the maps. Those of the city must be kept beside its
/// file.
Status measure_city_size(const House& house, const scene::Scene& city, const methods::Settings& reflection,
                         bool is_quick, int repeats, Report& report);

}  // namespace parvis::bench
