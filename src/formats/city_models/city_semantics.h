// What kinds the surfaces of a building are, where its file does not say: told from slope and position.
#pragma once

#include <vector>

#include "formats/city_models/city_assembly.h"

namespace parvis::scene {

/// Takes the kind away from the surfaces of one building that all have the same, if their slopes contradict
/// it: walls that lie level over a tenth of their area, or roofs and floors that stand over a third of it.
/// Kinds of a building that has several are left alone.
void drop_implausible_semantics(std::vector<CitySurface>& surfaces);

/// Names the surfaces of one building that have no semantics: level ones at its foot are its ground, others
/// that are less steep than 70 degrees roofs (from below: the undersides of what juts out), the rest walls.
/// The winding counts only for surfaces of a solid: other files wind them either way. Names given are left
/// alone.
void infer_semantics(std::vector<CitySurface>& surfaces);

}  // namespace parvis::scene
