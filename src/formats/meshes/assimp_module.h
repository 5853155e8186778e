// The module `assimp`: what of this room knows assimp.
#pragma once

#include "base/module.h"
#include "formats/readers/readers.h"

namespace parvis::scene {

/// The functions of the module that calls assimp.
struct AssimpFunctions {
  Result<formats::FileContent> (*read)(const std::filesystem::path& file, formats::UpAxis up,
                                       Errors& warnings);
};

/// Loaded in the workers' server when the first file of its formats is read.
inline constexpr Module<AssimpFunctions> assimp("assimp");

}  // namespace parvis::scene
