// OBJ, PLY, COLLADA, FBX, STL and other formats, by assimp.
#pragma once

#include <filesystem>

#include "base/result.h"
#include "formats/readers/readers.h"

namespace parvis::scene {

/// In metres, z up: the file is taken as y up (PLY and STL: z up) unless `up` says otherwise. Objects
/// keep their names. The file's extension alone decides which of assimp's importers reads it, and files that
/// it names are opened below its own folder only. A picture that is missing is named in `warnings` and
/// replaced by a checker. A file without triangles is an error. assimp crashes on files that are damaged: to
/// be called through formats::isolated.
Result<Model> read_with_assimp(const std::filesystem::path& file, formats::UpAxis up, Errors& warnings);

}  // namespace parvis::scene
