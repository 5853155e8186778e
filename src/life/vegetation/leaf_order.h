// An order of leaves of which every prefix is spread evenly over the plant.
#pragma once

#include <vector>

#include "life/vegetation/plant_shape.h"

namespace parvis::vegetation {

/// Puts the leaves of a shape into prefix order and divides them into clusters: along a curve that fills
/// space (Morton 1966) neighbours are close, so its stretches are clusters, and its places in bit-reversed
/// order (van der Corput 1935) are a low-discrepancy sample of it, whatever their number.
void order_leaves(PlantShape& shape);

}  // namespace parvis::vegetation
