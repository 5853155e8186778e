// How methods and overlays share the texture units and uniform blocks above those of the renderer.
#pragma once

#include "graphics/render/bindings.h"

namespace parvis::methods {

/// A method takes up to seven texture units from `first_method_unit` on, overlays those from
/// `first_overlay_unit` on.
inline constexpr GLuint first_method_unit = render::first_unit_above;
inline constexpr GLuint first_overlay_unit = first_method_unit + 7;

/// A method takes up to two uniform blocks from `first_method_block` on, overlays those from
/// `first_overlay_block` on.
inline constexpr GLuint first_method_block = render::first_block_above;
inline constexpr GLuint first_overlay_block = first_method_block + 2;

}  // namespace parvis::methods
