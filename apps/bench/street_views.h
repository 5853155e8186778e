// Views along the streets where traffic drives, and those that show many cars at once.
#pragma once

#include <vector>

#include "bench/report.h"
#include "house/stage/stage.h"

namespace parvis::bench {

/// Points on the lanes where traffic drives, from which a visitor or a driver looks, in an order that a seed
/// shuffles.
std::vector<Camera> street_views(const scene::Scene& scene, std::size_t count, float eye_height_m,
                                 float pitch_rad, int width, int height);

/// The scene with so many vehicles.
house::Play play_with(const House& house, const scene::Scene& scene, int vehicles);

/// Number of reflecting objects that a frame of this camera draws.
int reflectors_seen(house::Stage& stage, const Camera& camera, int width, int height);

/// Lets traffic drive until some view, from a balcony or a roof, sees between `minimum` and `maximum` cars.
Result<Camera> view_of_cars(house::Stage& stage, int minimum, int maximum, int width, int height,
                            Report& report);

}  // namespace parvis::bench
