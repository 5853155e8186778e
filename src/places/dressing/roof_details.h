// What stands on roofs: parapets along the free edges of flat ones, chimneys, and plant on large ones.
#pragma once

#include <vector>

#include "places/dressing/model_triangles.h"

namespace parvis::dressing {

/// Less steep than 10 degrees, where tiles would leak.
bool is_flat(const ModelTriangle& roof);

/// Adds them to the model whose roofs these triangles are, as parts "RoofEdge", "Chimney" and "RoofPlant". An
/// edge is free where no other roof lies beside it as high or higher. Small roofs stay bare; which of the
/// others have what depends on the number of their building.
void add_roof_details(scene::Model& model, const std::vector<ModelTriangle>& roofs);

}  // namespace parvis::dressing
