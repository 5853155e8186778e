// The one door from scripts to model files: each room that reads a format adds its reader.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"
#include "formats/readers/ground_on_map.h"
#include "scene/data/file_account.h"
#include "scene/data/model.h"

namespace parvis::formats {

/// How the file's axes are to be read: `file` leaves it to the format (glTF: y up; OBJ: y up; else z up).
enum class UpAxis : unsigned char { file, y, z };

/// A script's choices about reading a model file.
struct ModelReading {
  UpAxis up = UpAxis::file;
  std::optional<double> max_detail = {};  ///< of city models: the level of detail; the highest there is
  std::optional<double> cell_m = {};      ///< of grids of heights that have no place on the earth
  scene::GroundOnMap ground = {};         ///< on which a file without heights (OpenStreetMap) stands
  /// The map on which a file with a place on the earth is laid, as Model::map; empty: its own.
  std::string map = {};
  /// Filled with the place on the earth (degrees: east, north) by readers whose file says it; may be null.
  std::optional<glm::dvec2>* place_deg = nullptr;
};

/// A reader's result: the model in metres, z up, and the account of what the file holds. An account has no
/// default, so a reader without one does not compile.
struct FileContent {
  scene::Model model;
  scene::FileAccount account;
};

/// Warnings (missing textures, which a placeholder stands for) are added to `warnings`; what the account says
/// was left out needs none.
using ReadModel = std::function<Result<FileContent>(const std::filesystem::path& file,
                                                    const ModelReading& reading, Errors& warnings)>;

/// Whether the first bytes of a file (4096, or all that there are, unpacked) are those of a format.
using LooksRight = bool (*)(std::string_view front);

/// Whether a reader takes files that are packed (gzip, bzip2): it asks for their bytes by `read_unpacked`.
enum class TakesPacked : bool { no, yes };

/// An allow list: readers by the extensions of their files, each with what its files begin with.
class Readers {
 public:
  /// `extensions` with their dots, in lower case; each once. Third-party readers are wrapped by `isolated`.
  void add(std::initializer_list<const char*> extensions, const ReadModel& read, LooksRight looks_right,
           TakesPacked takes_packed = TakesPacked::no);

  /// Extensions count in any case, and below that of a packing (.json.gz). Errors: a file whose extension
  /// nobody reads (it names those that are read), one that is packed where its reader takes none that are (it
  /// says what unpacks it), one whose content is of another format than its name, and what is no regular
  /// file. Names in the model are valid UTF-8 whatever the file says. The model carries the account
  /// (`Model::account`), whose short form is added to `warnings`.
  Result<scene::Model> read(const std::filesystem::path& file, const ModelReading& reading,
                            Errors& warnings) const;

 private:
  struct Reader {
    ReadModel read;
    LooksRight looks_right;
    TakesPacked takes_packed;
  };
  std::map<std::string, Reader> by_extension_;
};

}  // namespace parvis::formats
