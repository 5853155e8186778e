// The one door from scripts to model files: each room that reads a format adds its reader.
#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>

#include "base/result.h"
#include "formats/readers/ground_on_map.h"
#include "scene/data/model.h"

namespace parvis::formats {

/// How the file's axes are to be read: `file` leaves it to the format (glTF: y up; OBJ: y up; else z up).
enum class UpAxis : unsigned char { file, y, z };

/// What a script may say about reading a model file.
struct ModelReading {
  UpAxis up = UpAxis::file;
  std::optional<double> max_detail = {};  ///< of city models: the level of detail; the highest there is
  std::optional<double> cell_m = {};      ///< of grids of heights that have no place on the earth
  scene::GroundOnMap ground = {};         ///< on which a file without heights (OpenStreetMap) stands
};

/// The model in metres, z up. Warnings (missing textures, which a placeholder stands for) are added to
/// `warnings`.
using ReadModel = std::function<Result<scene::Model>(const std::filesystem::path& file,
                                                     const ModelReading& reading, Errors& warnings)>;

/// Readers by the extensions of their files.
class Readers {
 public:
  /// `extensions` with their dots, in lower case; each once.
  void add(std::initializer_list<const char*> extensions, ReadModel read);
  /// The reader of every other file.
  void set_fallback(ReadModel read) { fallback_ = std::move(read); }

  /// Without a fallback, a file whose extension nobody reads is an error that names the extensions that are
  /// read.
  Result<scene::Model> read(const std::filesystem::path& file, const ModelReading& reading,
                            Errors& warnings) const;

 private:
  std::map<std::string, ReadModel> by_extension_;
  ReadModel fallback_;
};

}  // namespace parvis::formats
