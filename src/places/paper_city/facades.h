// Facades for buildings that are bare volumes, as most city models are.
#pragma once

#include <string_view>

#include "scene/data/model.h"

namespace parvis::city {

/// Gives brick and windows to the walls (triangles steeper than 70 degrees, once the model's z is up) of the
/// parts that match the pattern `target`. Walls of one plane hold a whole number of bays and storeys; what is
/// too small for a window is plain brick; buildings that touch are built of the same bricks. Returns the
/// number of triangles changed.
std::size_t add_facades(scene::Model& model, std::string_view target);

}  // namespace parvis::city
