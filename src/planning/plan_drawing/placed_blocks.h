// Blocks of drawings as the objects that they stand for.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "planning/design/placed_object.h"
#include "planning/plan_drawing/placed_drawing.h"

namespace parvis::plan_drawing {

/// The table of a planDrawing: "ARBRE*=tree, BANC=bench", names or patterns of blocks, each with a kind.
/// Errors: an entry that is no NAME=KIND.
Result<std::vector<std::pair<std::string, std::string>>> block_kinds(const std::string& table);

/// The objects that the drawing's blocks stand for, on layers that are shown, by the first entry of its table
/// that names them. Their sizes are those of what the blocks draw; the block's y axis is the front. A name is
/// the block's attribute NUM, NOM, NAME or ID, else the kind and a number; the height is that of HAUTEUR,
/// HAUTEUR_M, HEIGHT or HEIGHT_M in metres, else 0. The design is the drawing's name.
std::vector<design::PlacedObject> placed_blocks(const PlacedDrawing& placed);

}  // namespace parvis::plan_drawing
