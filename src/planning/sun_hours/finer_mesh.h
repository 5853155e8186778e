// Triangles divided until none is larger than asked for.
#pragma once

#include <glm/glm.hpp>

#include "base/mesh.h"

namespace parvis::sun_hours {

/// Appends the triangles of `mesh` (world coordinates), divided at the middle of their longest edge until no
/// edge is longer than `max_edge_m`: those whose middle then lies between `low` and `high` from above.
/// Neighbours are divided alike: no gaps appear. Normals are interpolated; uvs become zero.
void append_finer(Mesh& result, const Mesh& mesh, float max_edge_m, glm::vec2 low, glm::vec2 high);

}  // namespace parvis::sun_hours
