// The node sunPath.
#pragma once

#include <vector>

#include "base/registries.h"
#include "scene/script/node.h"

namespace parvis::light {

inline constexpr const char* sun_path_type = "sunPath";

/// Adds sunPath to the nodes that scripts may use, and the process that lets it follow dayLight.
void add_sun_path(Registries& registries);

/// The days of the year of which a node sunPath shows the arcs: the one that it names, in a year without it
/// the last, or both solstices and the equinox.
std::vector<int> sun_path_days(const scene::Node& node, int year);

}  // namespace parvis::light
