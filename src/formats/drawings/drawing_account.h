// The account of a drawing: what its file holds, what is drawn and what is left out.
#pragma once

#include <string>

#include "formats/drawings/drawing.h"
#include "scene/data/file_account.h"

namespace parvis::formats {

/// Entities by their types, layers, and what lies in layouts. `file` stands in messages.
scene::FileAccount account_of(const Drawing& drawing, const std::string& file);

}  // namespace parvis::formats
