// Grown plants in the renderer (003_d5b01da2d2f805f6, section 5.3.3): real geometry near, points and lines
// beside it from afar.
#pragma once

#include "graphics/render/drawables.h"

namespace parvis::vegetation {

/// The kind: drawn (plant_drawable.cpp) and traced (traced_plants.cpp).
render::DrawableKind scene_plants_kind();

/// Plants as rays see them: the real geometry.
scene::TracedKind traced_plants();

}  // namespace parvis::vegetation
