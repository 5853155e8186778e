// The parts of a model: meshes of glTF 2.0 on the nodes and instances that show them.
#pragma once

#include <vector>

#include "formats/gltf/gltf_file.h"
#include "formats/gltf/gltf_materials.h"
#include "formats/gltf/gltf_nodes.h"

namespace parvis::scene {

/// Appends the parts that the nodes of `model` show, and a node for each instance (EXT_mesh_gpu_instancing),
/// for each mesh on a node that mirrors it, and for each whose vertices lie far from its node: no node with a
/// part mirrors, so that triangles are wound alike everywhere. `sets`: of each material. Throws GltfProblem.
void read_parts(const GltfFile& file, const GltfNodes& nodes, const std::vector<UvSets>& sets, Model& model,
                FileAccount& account);

}  // namespace parvis::scene
