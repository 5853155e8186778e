// A scene for a file that nobody has described: dressing, ground, light and cameras by what the file holds.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "base/result.h"
#include "formats/readers/readers.h"
#include "scene/data/model.h"

namespace parvis::dressing {

/// True if the file is not a scene script (.xp): a model, to be shown by itself.
bool is_bare_file(const std::filesystem::path& file);

/// The script of a scene that shows `model`; `file` is what the script calls its file. The sun is that of
/// `place_deg` (degrees: east, north); without it, of somewhere in Europe.
std::string bare_scene(const scene::Model& model, const std::string& file,
                       const std::optional<glm::dvec2>& place_deg = {});

/// A script that was made up, and the folder that the scene has to be given as data.
struct WrittenScene {
  std::filesystem::path script, data_folder;
  bool is_new = false;  ///< else a script of the same content stood there
};

/// Reads a model file and writes the script that shows it as NAME.xp into `folder`. Nothing is overwritten:
/// where another script stands, NAME-2.xp and so on is written. Errors: those of the file's reader; a folder
/// that cannot be written to. Warnings of the reader come again when the scene is loaded.
Result<WrittenScene> write_bare_scene(const std::filesystem::path& file, const formats::Readers& readers,
                                      const std::filesystem::path& folder);

}  // namespace parvis::dressing
