// Meshes with fewer triangles and nearly the same surface.
#pragma once

#include <span>

#include "base/mesh.h"

namespace parvis::scene {

/// A mesh with as few triangles as keep its surface within about `max_error_m` of the given one (quadric
/// error metrics, Garland and Heckbert 1997, by meshoptimizer). Vertices that remain keep their normals and
/// uvs; others are removed. Rims stay as they are, so that parts which touch along them still do.
Mesh simplified(const Mesh& mesh, float max_error_m);

/// The same for meshes that touch each other, panels of one body: along edges that two of them share vertices
/// are left out of both, so that no cracks open. Within a mesh, vertices at one place become one where their
/// normals are less than `max_crease_deg` from each other, with the mean of these normals. Meshes may be left
/// without triangles.
void simplify_together(std::span<Mesh* const> meshes, float max_error_m, float max_crease_deg);

}  // namespace parvis::scene
