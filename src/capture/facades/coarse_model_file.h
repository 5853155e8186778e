// The model of a place as glTF with named objects, which any modelling program opens and Parvis reads
// back.
#pragma once

#include <filesystem>

#include "capture/facades/coarse_model.h"

namespace parvis::facades {

/// Writes `file` (.glb): a node and a mesh per named mesh, grey, seen from both sides.
Status write_meshes(const std::filesystem::path& file, const std::vector<NamedMesh>& meshes);

}  // namespace parvis::facades
