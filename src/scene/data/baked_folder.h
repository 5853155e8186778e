// Where what is baked for a scene lies.
#pragma once

#include <filesystem>
#include <set>
#include <string_view>

#include "scene/data/scene.h"

namespace parvis::scene {

/// NAME.baked beside the scene's file NAME.xp, and in it the folder `inside`, unless that is empty. Empty
/// where the scene has no file, or where a link leads elsewhere: nothing is read, written or removed there.
std::filesystem::path baked_folder(const Scene& scene, const std::filesystem::path& inside = {});

/// Removes the files of one extension (".reflector") from a folder, other than `kept`: what was baked of
/// other states. An empty `folder` has none.
void remove_other_files(const std::filesystem::path& folder, std::string_view extension,
                        const std::set<std::filesystem::path>& kept);

/// The error of whoever should write where `baked_folder` is empty.
Error no_baked_folder(const Scene& scene);

}  // namespace parvis::scene
