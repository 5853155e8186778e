// Ground between houses: paved where they stand close, as in a town; lawn where gardens are.
#pragma once

#include <string_view>

#include "scene/data/model.h"

namespace parvis::dressing {

/// Lays paving and lawn on the parts of a model that match the pattern `target`, seen from above: paving
/// where more than 30 % of the ground within some 40 m is below roofs (parts called RoofSurface). The parts
/// are divided along the edge; a part called NAME becomes two of that name. Returns the number of parts
/// changed.
std::size_t add_town_ground(scene::Model& model, std::string_view target);

}  // namespace parvis::dressing
