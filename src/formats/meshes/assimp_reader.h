// OBJ, PLY, COLLADA, FBX, STL and the other formats that assimp reads.
#pragma once

#include <filesystem>

#include "base/result.h"
#include "formats/readers/readers.h"

namespace parvis::scene {

/// In metres, z up: the file is taken as y up unless `up` says z. Objects keep their names. A picture that is
/// missing is named in `warnings` and replaced by a checker. A file without triangles is an error.
Result<Model> read_with_assimp(const std::filesystem::path& file, formats::UpAxis up, Errors& warnings);

}  // namespace parvis::scene
