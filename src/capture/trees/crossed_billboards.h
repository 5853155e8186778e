// The baseline of games: two upright pictures of the tree that cross each other in its middle.
#pragma once

#include <array>
#include <span>

#include "base/bounds.h"
#include "capture/trees/billboard_tree.h"
#include "capture/trees/tree_view.h"
#include "scene/data/model.h"

namespace parvis::trees {

/// Two photographs, as nearly at right angles as there are, each on an upright plane that faces its camera.
struct CrossedBillboards {
  glm::vec3 middle{0.0f};               ///< of the tree, metres; both planes pass through it
  std::array<glm::vec3, 2> normals{};   ///< of the planes: unit, level
  std::array<Pinhole, 2> cameras{};     ///< that project the pictures onto the planes
  std::array<ImageF, 2> photographs{};  ///< RGBA, premultiplied, linear light
};

/// Takes the first view and the one most nearly at a right angle to it, seen from above. `views` are two or
/// more.
CrossedBillboards crossed_billboards(std::span<const TreeView> views, const Bounds& tree);

/// Their picture by a camera: RGBA, premultiplied, linear light.
ImageF render_crossed_billboards(const CrossedBillboards& billboards, const Pinhole& camera);

/// Two crossed billboards as a model that any program shows, in the tree's frame: what the tree itself shows
/// from two of its photographs' places, as nearly at right angles as there are.
scene::Model crossed_model(const BillboardTree& tree);

}  // namespace parvis::trees
