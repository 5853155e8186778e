// What kinds the surfaces of a building are, where its file does not say: told from slope and position.
#pragma once

#include <vector>

#include "formats/city_models/city_assembly.h"

namespace parvis::scene {

/// Names the surfaces of one building that have no semantics: level ones at its foot are its ground, others
/// that are less steep than 70 degrees roofs (from below: the undersides of what juts out), the rest walls.
/// The winding counts only for surfaces of a solid: other files wind them either way. Names given are left
/// alone.
void infer_semantics(std::vector<CitySurface>& surfaces);

}  // namespace parvis::scene
