// The tree of nodes of glTF 2.0 (section 3.5.2). A graph that is none is made one: links that would close a
// circle or give a node a second parent are left out.
#pragma once

#include <vector>

#include "formats/gltf/gltf_file.h"
#include "scene/data/model.h"

namespace parvis::scene {

struct GltfNodes {
  std::vector<int> of_gltf;     ///< the model's node of each node of the file; no_index: not in the scene
  std::vector<int> gltf_of;     ///< the file's node of each node of the model; no_index: none, as of node 0
  std::vector<char> is_hidden;  ///< of each node of the model: KHR_node_visibility hides it or one above it
};

/// Appends the nodes of the file's scene, or of the whole file where it has no scene, below node 0 of
/// `model`; parents first. Links that were left out are reported in `warnings`, by the numbers of their
/// nodes; nodes that no scene shows, that are hidden or whose matrix shears are counted in `account`. A
/// matrix that shears becomes two nodes, the lower of which is the file's. Throws GltfProblem.
GltfNodes read_nodes(const GltfFile& file, Model& model, FileAccount& account, Errors& warnings);

}  // namespace parvis::scene
