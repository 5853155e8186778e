// Animations of glTF 2.0 (section 3.11): keyframes of nodes.
#pragma once

#include <vector>

#include "scene/gltf_file.h"
#include "scene/gltf_nodes.h"
#include "scene/model.h"

namespace parvis::scene {

/// All that move a node of the scene. Throws GltfProblem, which names the animation.
std::vector<Animation> read_animations(const GltfFile& file, const GltfNodes& nodes);

}  // namespace parvis::scene
