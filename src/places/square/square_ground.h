// The ground of the square: paving in fields and bands, carriageways with kerbs and crossings, pavements, and
// what stands on it: bollards.
#pragma once

#include "places/square/relief_mesh.h"

namespace parvis::square {

void add_square_ground(ReliefMesh& mesh);

}  // namespace parvis::square
