// Where what is baked for a scene lies.
#pragma once

#include <filesystem>

#include "scene/data/scene.h"

namespace parvis::scene {

/// NAME.baked beside the scene's file NAME.xp, and in it the folder `inside`, unless that is empty. Empty
/// where the scene has no file, or where a link leads elsewhere: nothing is read, written or removed there.
std::filesystem::path baked_folder(const Scene& scene, const std::filesystem::path& inside = {});

/// The error of whoever should write where `baked_folder` is empty.
Error no_baked_folder(const Scene& scene);

}  // namespace parvis::scene
