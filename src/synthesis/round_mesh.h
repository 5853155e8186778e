// Meshes of round things: turned on a lathe, drawn along a curve, and flat panels in squares.
#pragma once

#include <vector>

#include "base/mesh.h"

namespace parvis::synthesis {

/// Radius and height, metres, along the outline: upward shows the outside, downward the inside.
using Outline = std::vector<glm::vec2>;

/// A curve through the points, each piece of it in `parts` (Catmull and Rom).
Outline smooth(const Outline& points, int parts);

/// The outline turned about the z axis. Texture: u once round, v down from the outline's end to its start.
Mesh turned(const Outline& outline, int sides = 48);

/// A ring of a tube: its middle and its radius.
struct TubeRing {
  glm::vec3 centre;
  float radius;
};
/// A skin about a curve, closed at both ends; texture as `turned`.
Mesh tube(const std::vector<TubeRing>& rings, int sides = 12);

/// A rectangle in squares of about `cell_m`; its front is where `right` runs to the right and `up` upward.
/// Texture coordinates are metres: u along `right`, v against `up`.
Mesh panel(glm::vec3 corner, glm::vec3 right, glm::vec3 up, float cell_m);

/// A box of six panels.
Mesh panelled_box(glm::vec3 low, glm::vec3 high, float cell_m);

}  // namespace parvis::synthesis
