#include "capture/photographs/developed.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "base/files.h"
#include "base/image_io.h"
#include "base/path_inside.h"
#include "base/progress.h"
#include "capture/photographs/picture.h"

namespace parvis::photographs {
namespace {
namespace fs = std::filesystem;

/// A picture of the folder, and what it becomes.
struct Development {
  std::string from, to;  ///< relative to their folders
};

const std::set<std::string> developed_extensions{".heic", ".heif", ".avif", ".arw",  ".cr2", ".cr3",
                                                 ".dng",  ".nef",  ".orf",  ".pef",  ".raf", ".rw2",
                                                 ".srw",  ".webp", ".tif",  ".tiff", ".bmp"};

std::string without_extension(const std::string& name) {
  return fs::path(name).replace_extension().generic_string();
}

/// Those of the names of a folder's pictures that do not lie in `kept`, which may stand in it.
std::vector<std::string> outside(const fs::path& kept, const fs::path& pictures,
                                 std::vector<std::string> names) {
  const fs::path canonical_kept = fs::weakly_canonical(kept);
  std::erase_if(names, [&](const std::string& name) {
    return is_below(fs::weakly_canonical(pictures / name), canonical_kept);
  });
  return names;
}

/// The developments that a folder needs. Of several pictures of one name the first is taken.
std::vector<Development> developments_of(const std::vector<std::string>& names, std::set<std::string> taken,
                                         Errors& problems) {
  std::vector<Development> found;
  for (const std::string& name : names) {
    if (taken.insert(without_extension(name)).second)
      found.push_back({name, without_extension(name) + ".jpg"});
    else
      problems.push_back(error("{}: is left out, since another picture of its name stands beside it", name));
  }
  return found;
}

bool is_newer(const fs::path& made, const fs::path& original) {
  std::error_code missing;
  const auto of_made = fs::last_write_time(made, missing);
  return !missing && of_made > fs::last_write_time(original, missing) && !missing;
}

}  // namespace

Result<DevelopedFolder> developed(const fs::path& pictures, const fs::path& kept) {
  const std::vector<std::string> plain = outside(kept, pictures, picture_names(pictures));
  std::set<std::string> taken;
  for (const std::string& name : plain) taken.insert(without_extension(name));
  DevelopedFolder result{pictures, {}};
  const std::vector<Development> developments = developments_of(
      outside(kept, pictures, picture_names(pictures, developed_extensions)), taken, result.problems);
  if (developments.empty()) return result;
  result.folder = kept;
  Progress progress("developing photographs", plain.size() + developments.size());
  const auto make = [&](const std::string& from, const std::string& to, const auto& bytes_of) -> Status {
    progress.advance();
    std::error_code code;
    const Result<fs::path> file = path_inside(kept, to);
    if (!file) return file.errors();
    if (is_newer(*file, pictures / from)) return Ok{};
    const Result<std::string> bytes = bytes_of(pictures / from);
    if (!bytes) {
      fs::remove(*file, code);
      result.problems.push_back(bytes.errors().front());
      return Ok{};
    }
    fs::create_directories(file->parent_path(), code);
    if (code) return error("{}: cannot be made ({})", file->parent_path().string(), code.message());
    return write_file(*file, *bytes);
  };
  for (const std::string& name : plain)
    if (Status status = make(name, name, [](const fs::path& file) { return read_file(file); }); !status)
      return status.errors();
  for (const auto& [from, to] : developments)
    if (Status status = make(from, to, jpeg_of); !status) return status.errors();
  return result;
}

}  // namespace parvis::photographs
