// The sun's way over a day as something to be seen in a scene.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "graphics/light/day_light_time.h"
#include "scene/data/model.h"

namespace parvis::light {

/// The number of days that a path can show beside the present one: both solstices and the equinox.
inline constexpr std::size_t max_path_days = 3;

/// The pieces of all sun paths, each on a node of its own: the horizon as a ring of radius 1 about the origin
/// (x east, y north, z up), and tubes, beads and the sun's disc, which `sun_path_pose` puts in their places;
/// at rest they all lie in the middle.
/// All paths share one model, so that a path can follow place, day and hour while the scene runs. Nothing of
/// it casts a shadow or hides the sky.
std::shared_ptr<const scene::Model> sun_path_model();

/// Object::pose of the model: an arc for each of the `days` of the year (at most `max_path_days`), and one
/// for the day of `now` if it is not among them, on a sphere of radius 1 from where the sun rises to where it
/// sets, with a bead at each full hour of the clock; and the sun's disc where it stands `now`, larger than
/// beads. Days on which the sun does not rise have no arc, and below the horizon there is no disc: such
/// pieces lie, too small to be seen, inside the ring.
std::vector<glm::mat4> sun_path_pose(const PlaceAndTime& now, std::span<const int> days);

/// Puts the sun's disc alone where the sun stands `now`: all else is as it was for the same day.
void place_sun(const PlaceAndTime& now, std::vector<glm::mat4>& pose);

}  // namespace parvis::light
