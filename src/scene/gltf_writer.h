// A Model as glTF 2.0: one .glb with its pictures as files beside it, which any viewer shows. What glTF
// cannot say (mirror-like, translucent, casts no shadow) goes into "extras".
#pragma once

#include <filesystem>

#include "base/result.h"
#include "scene/model.h"

namespace parvis::scene {

/// Writes `file` (.glb) and its pictures NAME_TEXTURE.png or, where no alpha is used, .jpg for colour. Node 0
/// of the file turns z up to y up, so that reading gives the model again under one more node.
Status write_gltf(const std::filesystem::path& file, const Model& model);

}  // namespace parvis::scene
