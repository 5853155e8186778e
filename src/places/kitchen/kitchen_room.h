// The kitchen's walls, window, cupboards, worktop and hob.
#pragma once

#include "scene/data/model.h"

namespace parvis::kitchen {

/// Height of the worktop, on which things stand.
inline constexpr float worktop_height_m = 0.9f;
/// Height of the shelf on the tiled wall, left of the cupboards.
inline constexpr float shelf_height_m = 1.54f;
/// Height of the hob's glass, whose middle is at `hob_x_m`.
inline constexpr float hob_x_m = 0.62f, hob_height_m = worktop_height_m + 0.006f;

/// Adds the room to a model that has the kitchen's materials.
void add_room(scene::Model& model);

}  // namespace parvis::kitchen
