// OBJ, PLY, COLLADA, FBX, STL and other formats, by assimp.
#pragma once

#include <filesystem>

#include "base/result.h"
#include "formats/readers/readers.h"

namespace parvis::scene {

/// Reads a model in metres, z up: the file is taken as y up (PLY and STL: z up) unless `up` says otherwise,
/// or its heights would be those of a national grid's northings. Coordinates of a national grid are taken off
/// (Model::origin), in double precision for OBJ, PLY, STL and OFF. Objects keep their names, vertices their
/// colours (sRGB). The file's extension alone decides which of assimp's importers reads it, and files that it
/// names are opened below its own folder only. A picture that is missing is named in `warnings` and replaced
/// by a checker. A file without triangles is an error. assimp crashes on files that are damaged: to be called
/// through formats::isolated.
Result<formats::FileContent> read_assimp_content(const std::filesystem::path& file, formats::UpAxis up,
                                                 Errors& warnings);
/// The model alone, without the account of its file.
Result<Model> read_with_assimp(const std::filesystem::path& file, formats::UpAxis up, Errors& warnings);

}  // namespace parvis::scene
