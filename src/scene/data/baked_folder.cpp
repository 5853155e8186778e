#include "scene/data/baked_folder.h"

namespace parvis::scene {
namespace fs = std::filesystem;

fs::path baked_folder(const Scene& scene, const fs::path& inside) {
  if (scene.file.empty()) return {};
  std::error_code code;
  fs::path folder = fs::path(scene.file).replace_extension(".baked");
  if (fs::is_symlink(fs::symlink_status(folder, code))) return {};
  if (inside.empty()) return folder;
  folder /= inside;
  return fs::is_symlink(fs::symlink_status(folder, code)) ? fs::path() : folder;
}

Error no_baked_folder(const Scene& scene) {
  return error("{}: is a link, or has one inside; nothing is baked there. Remove the link",
               fs::path(scene.file).replace_extension(".baked").string());
}

}  // namespace parvis::scene
