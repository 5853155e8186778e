// Baking of reference maps.
#pragma once

#include "graphics/render/bake_steps.h"

namespace parvis::reference_maps {

/// Renders and keeps the maps of a state that are not kept yet. If a plan is wanted, draws the places of the
/// maps as discs, and as rings as many places spread evenly over all roads. Errors as bake_maps's, or that of
/// writing the plan.
Result<render::Baked> bake_and_plan(render::BakeInput& input);

}  // namespace parvis::reference_maps
