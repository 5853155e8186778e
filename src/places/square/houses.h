// The houses of the square and its streets, with roofs.
#pragma once

#include "places/square/layout.h"
#include "places/square/relief_mesh.h"

namespace parvis::square {

void add_houses(ReliefMesh& mesh, const std::vector<Building>& houses, std::uint64_t seed);

}  // namespace parvis::square
