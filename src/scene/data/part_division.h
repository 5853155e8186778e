// Cuts parts of models in several, triangle by triangle.
#pragma once

#include <span>

#include "scene/data/model.h"

namespace parvis::scene {

/// Parts like `part`, each of the triangles of one list alone. Vertices go with the triangles that need them;
/// of a mesh that deforms all stay in each, for its deformation counts them. Takes as long as the mesh is
/// large, however many lists there are, unless it deforms.
std::vector<Part> divided(const Part& part, std::span<const std::vector<std::uint32_t>> lists);

/// Takes the triangles out of `part` for which `takes[i]`, and returns a part like it that has them alone,
/// as by `divided`.
Part split_off(Part& part, const std::vector<bool>& takes);

}  // namespace parvis::scene
