// Captured trees in the renderer (003_d5b01da2d2f805f6, section 4.6): billboards back to front, the two
// closest photographs, over; levels of detail by pixels.
#pragma once

#include "capture/trees/scene_tree.h"
#include "graphics/render/drawables.h"

namespace parvis::trees {

/// The kind: drawn (tree_drawable.cpp) and traced (traced_tree.cpp).
render::DrawableKind scene_trees_kind();

/// How a view shows a tree whose box in the world is `bounds`: what its level of detail is chosen by.
SeenTree seen_tree(const SceneTree& tree, const Bounds& bounds, const render::View& view,
                   const render::Culling& culling);

/// Trees as rays see them.
scene::TracedKind traced_trees();

}  // namespace parvis::trees
