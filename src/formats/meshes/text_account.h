// What OBJ and PLY files hold that assimp passes over without a word.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scene/data/file_account.h"

namespace parvis::scene {

/// Counts statements of an OBJ that are not read (free-form curves and surfaces) and material libraries that
/// are not beside it; elements and properties of a PLY, colours of faces of an OFF and of facets of an STL
/// that are not read. Files with other extensions have none.
void count_what_assimp_drops(std::string_view bytes, const std::filesystem::path& file,
                             std::string_view extension, FileAccount& account);

/// A PLY whose properties bear the names that assimp looks for (of colours, "red" in place of "diffuse_red");
/// empty where they do already, and of other files.
std::string with_known_names(std::string_view bytes, std::string_view extension);

}  // namespace parvis::scene
