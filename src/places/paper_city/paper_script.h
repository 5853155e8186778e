// The script of the paper's city: light, models, roads, traffic and good places to look from.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>

namespace parvis::city {

inline constexpr float sun_azimuth_deg = 132.0f, sun_elevation_deg = 46.0f;
/// Unit vector to the sun of the script.
glm::vec3 to_sun();

/// The same city with people who walk along its pavements and across the crossing, where a car's side is
/// seen.
std::string people_script(std::span<const std::string> walker_files);

/// `vehicle_files` are the models of the traffic.
std::string paper_script(std::span<const std::string> vehicle_files, std::uint64_t seed);

/// The same city under the true sun of a place and day, with scenarios for its hours, cars parked along a
/// street and a tour past them.
std::string day_script(std::span<const std::string> car_files);

}  // namespace parvis::city
