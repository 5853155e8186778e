// The plan of a sun study, to be read by people.
#pragma once

#include "base/image.h"
#include "planning/sun_hours/sun_study.h"

namespace parvis::sun_hours {

/// The colour of a number of hours, 0 to 255 in sRGB, as a share of the most: dark blue for none, over green,
/// to yellow.
glm::vec3 hours_colour(double share);

/// North up: ground in the colours of its hours, roofs in paler ones, what is not known white. Below stand a
/// scale with a step and a number for each hour, and a bar of metres. Where the study says which ground is
/// judged, a line runs around that, and its area and share of sunny ground stand below.
struct SunPlan {
  Image8 picture;
  int cell_px = 1;       ///< side of a cell
  glm::ivec2 corner{0};  ///< the pixel of the plan's upper left corner
};
/// Cells are as large as makes the plan about 1,200 pixels long, and at most 16 pixels; 1 in longer plans.
SunPlan sun_plan(const SunStudy& study);

}  // namespace parvis::sun_hours
