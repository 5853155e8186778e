// Skins and morph targets of glTF 2.0 (sections 3.7.2.2 and 3.7.3.3).
#pragma once

#include "formats/gltf/gltf_file.h"
#include "formats/gltf/gltf_nodes.h"
#include "scene/data/deformation.h"

namespace parvis::scene {

/// How `mesh`, a primitive of a mesh that hangs on a node, deforms; an empty Deformation where it does not.
/// Throws GltfProblem, which names the skin or the mesh: joints that are missing or not in the scene, a
/// vertex that hangs on a joint that there is not, targets of another length, weights that are not as many as
/// targets.
Deformation read_deformation(const GltfFile& file, const GltfNodes& nodes, const GltfFile::Json& node,
                             const GltfFile::Json& mesh_source, const GltfFile::Json& primitive,
                             const Mesh& mesh);

}  // namespace parvis::scene
