// The light in which a tree was photographed, taken out of its textures, and another put in: trees are lit by
// the sun and sky of the scene they stand in.
#pragma once

#include <optional>
#include <vector>

#include "capture/trees/billboard_tree.h"

namespace parvis::trees {

/// The share of the sun's light that reaches each cell from a direction (unit), 0..1: what the cells between
/// let through.
std::vector<float> sun_visibility(const BillboardTree& tree, glm::vec3 to_sun);
/// The same of a sky that is equally bright everywhere, weighed alike from all sides above.
std::vector<float> sky_visibility(const BillboardTree& tree);

/// Finds the light of the photographs: the brightness of each cell is `sun` times what it sees of the sun
/// plus `sky` times what it sees of the sky, by least squares over the cells. Without `to_sun` the direction
/// is the one that explains most.
CapturedLight estimated_light(const BillboardTree& tree, std::optional<glm::vec3> to_sun = std::nullopt);

/// The tree as another sun would show it, with the same sky.
BillboardTree relit(BillboardTree tree, glm::vec3 to_sun);

/// The tree with its textures as albedo: divided by the light that each cell had, which is taken to lie
/// within a factor of `contrast` of the mean. What a cell's own opacity says of its light is noisy: with a
/// contrast of 6 the crown of a real capture falls into light and dark cells.
BillboardTree unlit(BillboardTree tree, float contrast = 1.5f);

}  // namespace parvis::trees
