// Where wheels belong on a body that comes without: in the middle of its arches.
#pragma once

#include <optional>

#include "places/car_bodies/side_view.h"

namespace parvis::car_bodies {

/// Four wheels, in the model's frame, metres; the attributes of the node `wheels`.
struct WheelFit {
  float left_x = 0.0f, right_x = 0.0f;  ///< of the two axles, the smaller x first
  float axle_z = 0.0f, track = 0.0f, radius = 0.0f, width = 0.0f;
};

/// Wheels for the two arches of a body: openings or insets in the lower half of its side, each with a round
/// upper edge, to which a circle is fitted (Kasa 1976). Nothing where there are not two.
std::optional<WheelFit> fit_wheels(const SideView& side);

/// True if the car drives toward negative x: its cabin lies behind the middle, so its front is away from it.
bool faces_back(const SideView& side);

}  // namespace parvis::car_bodies
