// Animations of glTF 2.0 (section 3.11): keyframes of nodes and of the weights of morph targets.
#pragma once

#include <vector>

#include "formats/gltf/gltf_file.h"
#include "formats/gltf/gltf_nodes.h"
#include "scene/data/model.h"

namespace parvis::scene {

/// All that move a node of the scene; channels that move nothing of it are left out. Throws GltfProblem,
/// which names the animation.
std::vector<Animation> read_animations(const GltfFile& file, const GltfNodes& nodes);

}  // namespace parvis::scene
