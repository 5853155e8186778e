// The one door from scripts to model files.
#pragma once

#include <filesystem>
#include <optional>

#include "base/result.h"
#include "scene/ground_on_map.h"
#include "scene/model.h"

namespace parvis::scene {

/// How the file's axes are to be read: `file` leaves it to the format (glTF: y up; OBJ: y up; else z up).
enum class UpAxis : unsigned char { file, y, z };

/// What a script may say about reading a model file.
struct ModelReading {
  UpAxis up = UpAxis::file;
  std::optional<double> most_detail = {};  ///< of city models: the level of detail; the highest there is
  std::optional<double> cell_m = {};       ///< of grids of heights that have no place on the earth
  GroundOnMap ground = {};                 ///< on which a file without heights (OpenStreetMap) stands
};

/// The model in metres, z up. Warnings (missing textures, which a placeholder stands for) are added to
/// `warnings`.
Result<Model> model_from_file(const std::filesystem::path& file, const ModelReading& reading,
                              Errors& warnings);

}  // namespace parvis::scene
