// Lengths and directions in tags of OpenStreetMap.
#pragma once

#include <optional>
#include <string>

#include "formats/city_models/osm_file.h"

namespace parvis::scene {

/// Height of a storey where levels are counted, metres.
inline constexpr double osm_level_m = 3.0;

/// "12", "12.5 m", "40'" (feet), "12;15" (the first), in metres; nothing for what is no number or longer than
/// 2 km.
std::optional<double> metres_in(const std::string& text);

/// "90", or a point of the compass ("E", "SSW"), in degrees clockwise from north.
std::optional<double> degrees_in(const std::string& text);

/// The length that tag `height` gives, else storeys of `levels`, else `otherwise`, metres.
double metres_or(const OsmTags& tags, const char* height, const char* levels, double otherwise);

}  // namespace parvis::scene
