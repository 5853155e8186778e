// Materials of glTF 2.0 (section 3.9), with KHR_texture_transform, EXT_texture_webp, _avif,
// KHR_materials_clearcoat, _emissive_strength, _transmission, _ior and _volume, and their pictures. What
// transmits light and has a volume is solid glass, else a pane.
#pragma once

#include "formats/gltf/gltf_file.h"
#include "scene/data/model.h"

namespace parvis::scene {

/// The sets of texture coordinates (TEXCOORD_n) that a material's textures take; -1: none.
struct UvSets {
  int first = 0, second = -1;
};

/// Appends all materials of the file to `model`, which has none, with their textures; and behind them a plain
/// one, for meshes that name none. A picture that is missing or damaged is named in `warnings` and replaced
/// by a visible checker; what the model cannot show is counted in `account`. Returns the sets of each. Throws
/// GltfProblem.
std::vector<UvSets> read_materials(const GltfFile& file, Model& model, FileAccount& account,
                                   Errors& warnings);

}  // namespace parvis::scene
