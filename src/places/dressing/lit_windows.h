// Windows of dressed walls behind which there is light by night.
#pragma once

#include <optional>

#include "scene/data/model.h"

namespace parvis::dressing {

/// A model, in the frame of `model`, of some of the windows of the walls that add_facades has given it: the
/// glass of their pictures, lit from inside in one of three colours, just before the wall. Windows are
/// distinguished by the gaps of wall between them; which of them are lit follows from their places alone.
/// Nothing where the model has no such walls; without parts where none of their windows is lit.
std::optional<scene::Model> lit_windows(const scene::Model& model);

}  // namespace parvis::dressing
