// Meshes with fewer triangles and nearly the same surface.
#pragma once

#include "base/mesh.h"

namespace parvis::scene {

/// A mesh with as few triangles as keep its surface within about `max_error_m` of the given one (quadric
/// error metrics, Garland and Heckbert 1997, by meshoptimizer). Vertices that remain keep their normals and
/// uvs; others are removed. Rims stay as they are, so that parts which touch along them still do.
Mesh simplified(const Mesh& mesh, float max_error_m);

}  // namespace parvis::scene
