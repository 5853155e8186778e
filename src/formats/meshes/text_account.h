// What OBJ and PLY files hold that assimp passes over without a word.
#pragma once

#include <filesystem>
#include <string_view>

#include "scene/data/file_account.h"

namespace parvis::scene {

/// Counts statements of an OBJ that are not read (free-form curves and surfaces) and material libraries that
/// are not beside it; elements and properties of a PLY that are not read. Files with other extensions have
/// none.
void count_what_assimp_drops(std::string_view bytes, const std::filesystem::path& file,
                             std::string_view extension, FileAccount& account);

}  // namespace parvis::scene
