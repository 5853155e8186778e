// The shadows that a facade's photographs show: how dark they are, and how bright each surface is in the sun.
#pragma once

#include "capture/facades/packed_facade.h"

namespace parvis::facades {

/// Sets `lit_of_surface` and `kept_in_shadows` from the colours of points of each surface, as they are seen
/// from the middle of the photographs' places: see photographs::lit_and_shaded. Of a facade of more than 256
/// MB of tiles, which would take a gigabyte decoded, nothing is found: photographs::kept_in_usual_shadow
/// holds.
void find_shadows(PackedFacade& facade);

}  // namespace parvis::facades
