// Materials of glTF 2.0 (section 3.9), with KHR_texture_transform, _clearcoat, _emissive_strength,
// _transmission, _ior and _volume, and their pictures. What transmits light and has a volume is solid glass,
// else a pane.
#pragma once

#include "formats/gltf/gltf_file.h"
#include "scene/data/model.h"

namespace parvis::scene {

/// Appends all materials of the file to `model`, which has none, with their textures; and behind them a plain
/// one, for meshes that name none. A picture that is missing or damaged is named in `warnings` and replaced
/// by a visible checker. Throws GltfProblem.
void read_materials(const GltfFile& file, Model& model, Errors& warnings);

}  // namespace parvis::scene
