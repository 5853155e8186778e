// Roofs of city models: tiles on those that slope, gravel on those that do not.
#pragma once

#include <string_view>

#include "scene/data/model.h"

namespace parvis::dressing {

/// Covers the parts that match the pattern `target`. Courses of tiles run level; roofs that touch have one
/// colour. Materials that later nodes can change: "roof tiles" and "flat roof". With `has_details` parapets,
/// chimneys and plant are added (roof_details.h). Returns the number of triangles changed.
std::size_t add_roofs(scene::Model& model, std::string_view target, bool has_details = true);

}  // namespace parvis::dressing
