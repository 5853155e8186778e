// What walls are made of: rendered plaster, ashlar, brick. Painted first, under everything else.
#pragma once

#include <cstdint>

#include "synthesis/surface_canvas.h"

namespace parvis::synthesis {

enum class Wall : std::uint8_t { plaster, ashlar, brick };

/// Covers the whole canvas with a wall of a mean colour (linear), with detail at the scales of a metre
/// (stains), a decimetre (trowel marks, stones, bricks) and a centimetre (grain).
void paint_wall(SurfaceCanvas& canvas, Wall wall, glm::vec3 colour, std::uint32_t seed);

/// Dirt that rain has left on what is already painted: darker streaks that run down, `strength` 0..1.
void paint_streaks(SurfaceCanvas& canvas, const Rect& rect, float strength, std::uint32_t seed);

}  // namespace parvis::synthesis
