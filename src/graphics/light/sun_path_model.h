// The sun's way over a day as something to be seen in a scene.
#pragma once

#include <memory>
#include <span>

#include "graphics/light/day_light_time.h"
#include "scene/data/model.h"

namespace parvis::light {

/// An arc for each of the `days` of the year at `place`, on a sphere of `radius_m` about the origin (x east,
/// y north, z up), from where the sun rises to where it sets, with a bead at each full hour of the clock, and
/// the horizon as a ring. Days on which the sun does not rise have no arc. Nothing of it casts a shadow or
/// hides the sky.
std::shared_ptr<const scene::Model> sun_path_model(PlaceAndTime place, std::span<const int> days,
                                                   float radius_m);

}  // namespace parvis::light
