#include "scene/script/named_file.h"

namespace parvis::scene {
namespace fs = std::filesystem;

Result<fs::path> find_named_file(const std::string& name, const Roots& roots, const FileLocation& where) {
  const fs::path folder = fs::path(where.file).parent_path();
  if (folder.empty() || folder == roots.scene_folder()) return roots.find(name, where);
  // A path that is not relative is found below any root, and nowhere else.
  if (Result<fs::path> beside = roots.find((folder / name).string(), where); beside) return beside;
  Result<fs::path> found = roots.find(name, where);
  if (found) return found;
  return error_at(where, "{}; it was looked for beside the script, too ({})", found.errors().front().message,
                  folder.string());
}

}  // namespace parvis::scene
