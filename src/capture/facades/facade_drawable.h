// Draws facade(...) nodes: every photograph's tiles in one texture, every surface in one pass.
#pragma once

#include "graphics/render/drawables.h"

namespace parvis::facades {

/// The kind of all facades of a scene: its drawable, and its counterpart in the ray tracer.
render::DrawableKind facades_kind();

}  // namespace parvis::facades
