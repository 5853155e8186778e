// What the clocks of a place show in its summer.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>

namespace parvis::dressing {

/// Hours by which clocks are ahead of universal time in the summer of a place (degrees: east, north): those
/// of the zone whose city lies nearest, by the time zone database in `zones`; without one, the sun's hour in
/// whole ones.
double summer_clock_h(glm::dvec2 place_deg, const std::filesystem::path& zones = "/usr/share/zoneinfo");

}  // namespace parvis::dressing
