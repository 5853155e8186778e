// Terrain that is cut and filled under roads.
#pragma once

#include "base/mesh.h"
#include "base/result.h"
#include "land/roads/earthworks.h"
#include "scene/data/scene.h"

namespace parvis::scene {

/// A mesh of ground as the works leave it. Its triangles are divided where the works bend them, until their
/// edges lie within 1 cm of what the works say or are shorter than a metre. Meshes that share edges still do
/// afterwards: whether an edge is divided follows from its ends alone.
Mesh shaped(const Mesh& mesh, const glm::mat4& world_from_mesh, const Earthworks& works);

/// Shapes the static terrain of the scene for `roads`, which are in the world, and for the turns between them
/// that the scene's lanes make: the models of its objects are replaced by changed copies. An error where
/// memory does not suffice: the terrain stays as it is.
Status shape_terrain(Scene& scene, std::span<const Road> roads);

}  // namespace parvis::scene
