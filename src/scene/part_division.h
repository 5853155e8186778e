// Cuts parts of models in two, triangle by triangle.
#pragma once

#include "scene/model.h"

namespace parvis::scene {

/// Takes the triangles out of `part` for which `takes[i]`, and returns a part like it that has them alone.
/// Vertices go with the triangles that need them; of a mesh that bends all stay in both, for its deformation
/// counts them.
Part split_off(Part& part, const std::vector<bool>& takes);

}  // namespace parvis::scene
