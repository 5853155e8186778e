// The pieces of solid glass that a model has: bodies, and open sheets.
#pragma once

#include <map>
#include <vector>

#include "scene/data/model.h"

namespace parvis::scene {

/// Triangles of one kind of glass (index of refraction, absorption) that hang together over their edges. What
/// is closed bounds a body, together with the surfaces of the cavities in it.
struct GlassPiece {
  Mesh mesh;  ///< in the model's frame, at rest
  int material = 0;
  bool is_closed = true;
  double volume = 0.0;  ///< of its glass, without the cavities, if it is closed; in the model's frame
  std::map<std::size_t, std::vector<std::uint32_t>> triangles;  ///< of each part that has any
};

/// None where no material refracts. What has no three corners is left out.
std::vector<GlassPiece> glass_pieces(const Model& model);

/// Makes the triangles of each of them parts of their own: what leaves a body out shows the others.
void divide_glass(Model& model);

}  // namespace parvis::scene
