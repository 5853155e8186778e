// Which extensions of glTF 2.0 are read, and what becomes of the others.
#pragma once

#include "formats/gltf/gltf_file.h"
#include "scene/data/file_account.h"

namespace parvis::scene {

/// Throws GltfProblem where the file requires an extension without which it cannot be shown.
void check_required_extensions(const GltfFile& file);

/// Counts the extensions that the file says it uses: those that are read, and those that are not.
void count_extensions(const GltfFile& file, FileAccount& account);

}  // namespace parvis::scene
