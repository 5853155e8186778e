// A wheel for cars that come without: a tyre with a rounded shoulder and a rim with spokes.
#pragma once

#include "scene/data/model.h"

namespace parvis::scene {

struct WheelShape {
  float radius_m = 0.31f;
  float width_m = 0.20f;
  float rim_radius_m = 0.21f;
  int segments = 48;                ///< of a circle
  bool has_round_shoulders = true;  ///< of the tyre; else its profile has half as many points
};

/// A wheel about the origin; turns about y; the outer side looks to +y (left). One part "tyre", one "rim".
Model make_wheel(const WheelShape& shape);

}  // namespace parvis::scene
