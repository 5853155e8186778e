// Lengths and directions in tags of OpenStreetMap.
#pragma once

#include <optional>
#include <string>

#include "formats/city_models/osm_file.h"
#include "scene/data/file_account.h"

namespace parvis::scene {

/// Height of a storey where levels are counted, metres.
inline constexpr double osm_level_m = 3.0;
/// No building has as many.
inline constexpr double max_levels = 660.0;

/// "12", "12.5 m", "12,5", "1250 cm", "40'", "6'4\"", "40 ft", "12;15" (the first), in metres; nothing for
/// what is no number, has a unit that is not known, or is longer than 2 km.
std::optional<double> metres_in(const std::string& text);

/// "3", "2.5", "2,5", "2;3" (the first).
std::optional<double> number_in(const std::string& text);

/// "90", "90°", or a point of the compass ("E", "SSW", "north-east"), in degrees clockwise from north.
std::optional<double> degrees_in(const std::string& text);

/// The length that tag `height` gives, else storeys of `levels`, else `otherwise`, metres.
double metres_or(const OsmTags& tags, const char* height, const char* levels, double otherwise);

/// The length that a tag gives where it lies between two others, else `otherwise`, metres.
double metres_within(const OsmTags& tags, const char* key, double min_m, double max_m, double otherwise);

/// Counts tags whose number or unit cannot be read as left out, by key.
void account_for_measures(const OsmFile& osm, FileAccount& account);

}  // namespace parvis::scene
