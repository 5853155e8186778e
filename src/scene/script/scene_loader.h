// Scene scripts (extension .xp) to scenes.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "base/result.h"
#include "scene/script/node_registry.h"
#include "scene/script/scene_builder.h"

namespace parvis::scene {

/// Reads `script` and every file it names: below the script's folder, or below one of `data_folders`.
/// All errors are reported at once: first those of the scripts, and when they are right those of the models
/// and pictures.
Result<LoadedScene> load_scene(const std::filesystem::path& script, const NodeRegistry& registry,
                               std::span<const std::filesystem::path> data_folders = {});

/// Only the scripts: syntax, node types, values, names, includes, and whether every file is there. Opens no
/// model.
Status check_scene(const std::filesystem::path& script, const NodeRegistry& registry,
                   std::span<const std::filesystem::path> data_folders = {});

}  // namespace parvis::scene
