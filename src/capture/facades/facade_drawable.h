// Draws facade(...) nodes: every photograph's tiles in one texture, every surface in one pass.
#pragma once

#include "capture/facades/facade_textures.h"
#include "graphics/render/drawables.h"

namespace parvis::facades {

/// Where the photographs of a pixel are chosen among.
enum class Compared : std::uint8_t {
  chosen,  ///< the few that its triangle is looked up in from the viewpoint (ViewChooser)
  all      ///< all that hold its triangle: for benches, which tell what choosing saves
};

/// The kind of all facades of a scene: its drawable, and its counterpart in the ray tracer.
render::DrawableKind facades_kind(Compared compared = Compared::chosen,
                                  HeldTexels held = HeldTexels::for_renderer);

}  // namespace parvis::facades
