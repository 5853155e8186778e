// Files of OpenGL Performer (.pfb), which the thesis's scripts name and nothing reads any more.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/files.h"
#include "scene/script/node.h"

namespace parvis::scene {

/// True for names that end in .pfb, in any case.
bool is_performer_file(const std::string& name);

/// The file that is read in its place: the one of the same name that ends in .glb, .gltf, .iv or .wrl, the
/// first that there is. The error says how to get one.
Result<std::filesystem::path> in_place_of_performer_file(const std::string& name, const Roots& roots,
                                                         const FileLocation& where);

/// Warnings for the user where an attribute of the node names such a file; empty if none does.
Errors replaced_performer_files(const Node& node);

}  // namespace parvis::scene
