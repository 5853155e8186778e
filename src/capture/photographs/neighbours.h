// Which photographs of a set do not belong with the others.
#pragma once

#include <vector>

#include "base/result.h"
#include "capture/photographs/photograph.h"

namespace parvis::photographs {

/// How one photograph stands among its neighbours, those that see points it sees.
struct Fit {
  int neighbours = 0;                   ///< photographs with at least `min_shared_points` points in common
  int points = 0;                       ///< points that it and another photograph see
  double reprojection_error_px = -1.0;  ///< mean; -1 without points
};

inline constexpr int min_shared_points = 12;

/// Fits of all photographs, in the order of the set.
std::vector<Fit> fits(const PhotographSet& set);

/// A message for each photograph whose camera does not fit: no neighbours, hardly any points of those that
/// its neighbours have, or an error far above theirs (3 times the median and above 1.5 pixels).
Errors cameras_that_do_not_fit(const PhotographSet& set);

/// Takes these photographs out, with points that fewer than two others see, and returns the messages. Nothing
/// is taken out where fewer than two photographs would stay.
Errors leave_out_what_does_not_fit(PhotographSet& set);

}  // namespace parvis::photographs
