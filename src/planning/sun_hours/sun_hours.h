// Hours of direct sun over the surfaces of a scene between two dates: what planners judge shade by.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "graphics/light/day_light_time.h"
#include "graphics/reference/ray_scene.h"

namespace parvis::sun_hours {

/// A point of a surface, lifted off it, and the surface's unit normal.
struct SunPoint {
  glm::vec3 position, normal;
};

/// Which suns count.
struct SunPeriod {
  light::PlaceAndTime place;  ///< year and clock too; day and hour do not count
  /// Days of the year, both included; `last_day` >= `first_day`, and beyond the year's days in the next ones.
  int first_day = 80, last_day = 80;
  int day_step = 1;                ///< every so many days stands for those around it
  double step_h = 1.0 / 15.0;      ///< the sun is looked up at this interval; changes between are bisected
  int bisections = 3;              ///< of a step in which the sun comes or goes: 30 seconds of four minutes
  double min_elevation_deg = 0.0;  ///< of the sun's centre, refracted
};

/// Hours of direct sun of each point, mean per day of the period.
///
/// A ray to the sun's centre at each step decides; between two steps that differ the moment of change is
/// bisected to some thirty seconds, so that the result is as good as rays every minute (but for gaps shorter
/// than a step). Points that face away from the sun have none. Same result for any number of threads.
std::vector<float> sun_hours(const reference::RayScene& scene, const std::vector<SunPoint>& points,
                             const SunPeriod& period);

/// The same with a ray each minute: what `sun_hours` is judged by.
std::vector<float> sun_hours_by_minutes(const reference::RayScene& scene, const std::vector<SunPoint>& points,
                                        const SunPeriod& period);

}  // namespace parvis::sun_hours
