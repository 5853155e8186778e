// One bay of an arcade: two half piers, the arch between them, and the gallery behind.
#pragma once

#include "places/square/facade.h"

namespace parvis::square {

/// Builds the bay from x0 to x1 of the mesh's frame. `shop`: which front of the style's strip stands behind.
void add_arcade_bay(ReliefMesh& mesh, const FacadeStyle& style, float x0, float x1, int shop);

/// A wall across the gallery at x, with an arch where it is open; it looks to the left or to the right.
void add_gallery_end(ReliefMesh& mesh, const FacadeStyle& style, float x, bool looks_right, bool is_open);

}  // namespace parvis::square
