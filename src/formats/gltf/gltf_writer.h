// A model, or what stands in a scene, as glTF 2.0: one .glb with its pictures as files beside it, which any
// viewer shows; with skins, morph targets, animations and cameras. What glTF cannot say (mirror-like,
// translucent, casts no shadow, backdrop) goes into "extras".
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "scene/data/scene.h"

namespace parvis::scene {

/// Writes `file` (.glb) and its pictures NAME_TEXTURE.png or, where no alpha is used, .jpg for colour. Node 0
/// of the file turns z up to y up, so that reading gives the model again under one more node.
Status write_gltf(const std::filesystem::path& file, const Model& model);

/// The same of objects, each on a node of its name; those of one model share its meshes. An object that plays
/// an animation stands at rest and has all animations of its model; others stand as they are now.
Status write_gltf(const std::filesystem::path& file, std::span<const Object* const> objects,
                  std::span<const NamedCamera> cameras);

/// A file for browsers, in memory.
struct PackedGltf {
  std::string glb;  ///< with its pictures inside and packed meshes (gltf_packing.h)
  /// Pictures of more pixels than those inside: the number of the image that each replaces, and its bytes.
  std::vector<std::pair<int, std::string>> sharper;
};

/// The same objects for browsers, without animations; their models have no deformations. The longest side of
/// textures is `first_px` inside the file and `max_px` in the sharper pictures, at most.
Result<PackedGltf> packed_gltf(std::span<const Object* const> objects, int first_px, int max_px);

}  // namespace parvis::scene
