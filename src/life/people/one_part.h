// People as one mesh of one material, for those who are far: what they wear is in the colours of the
// vertices.
#pragma once

#include <vector>

#include "life/people/clothes.h"
#include "life/people/head.h"
#include "scene/data/model.h"

namespace parvis::people {

struct Someone;

/// A mesh bound to the bones, as a part of a model whose nodes are `nodes_of`.
scene::Part bound_part(const BodyField& body, const char* name, Mesh mesh, Surface surface, Moves moves);

/// Bound parts joined to one.
struct OnePart {
  scene::Part part;               ///< colours: the shade of folds; of the face, its colour
  std::vector<Surface> surfaces;  ///< of each vertex

  /// Appends a bound part. `texture`: of its colour, sRGB, which the vertices take; null: none.
  void add(const scene::Part& bound, const Image8* texture = nullptr);
};

/// Somebody as a few tubes: trunk, head, limbs and what hangs from the hips.
OnePart distant_body(const BodyField& body, const HeadField& head, const Someone& who);

}  // namespace parvis::people
