// What a design changes in the hours of direct sun on the ground.
#pragma once

#include <cstdint>
#include <vector>

#include "planning/sun_hours/sun_hours.h"
#include "scene/data/scene.h"

namespace parvis::plan_drawing {

/// Hours of direct sun per day on a grid of the ground, before and after.
struct SunDifference {
  int columns = 0, rows = 0;  ///< row 0 is the southernmost
  glm::dvec2 corner{0.0};     ///< least x and y, in the scene's frame
  double cell_m = 0.0;
  double max_hours = 0.0;               ///< of an open plain
  std::vector<std::uint8_t> is_ground;  ///< 0: built, or nothing
  std::vector<float> before, after;     ///< of each cell; 0 where there is no ground

  /// Area of the ground, m2.
  double area_m2() const;
  /// Mean hours of the ground.
  double mean_hours(const std::vector<float>& hours) const;
  /// Area of the ground with so many hours or more, m2.
  double area_with_m2(const std::vector<float>& hours, double at_least_h) const;
  /// Area whose hours change by `by_h` or more, m2: gained where it is positive, lost where negative.
  double area_changed_m2(double by_h) const;
};

/// How high above the ground the sun is looked for: over paving and lawns that a design lays there.
inline constexpr float sun_above_ground_m = 0.1f;

/// The ground of `bare`, the place without both designs, in the sun of the place with either. `area`: x and y
/// of its least and greatest corner. Things that move cast no shadow. Errors: no ground there, as study_sun.
Result<SunDifference> sun_difference(const scene::Scene& bare, const scene::Scene& before,
                                     const scene::Scene& after, const sun_hours::SunPeriod& period,
                                     const glm::dvec4& area, double cell_m);

}  // namespace parvis::plan_drawing
