#include "base/path_inside.h"

namespace parvis {
namespace fs = std::filesystem;

bool is_below(const fs::path& path, const fs::path& folder) {
  const fs::path relative = path.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

Result<fs::path> path_inside(const fs::path& folder, const fs::path& name) {
  std::error_code code;
  const fs::path root = fs::weakly_canonical(fs::absolute(folder, code), code);
  const fs::path path = fs::weakly_canonical(root / name, code);
  if (code || !is_below(path, root))
    return error("{}: leads out of {} by a link; put a file or a folder in its place",
                 (folder / name).string(), folder.string());
  return folder / name;
}

}  // namespace parvis
