#include "base/files.h"

#include <fstream>
#include <sstream>

namespace parvis {
namespace fs = std::filesystem;

Result<std::string> read_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || fs::is_directory(file)) return error("{}: cannot be opened for reading", file.string());
  std::ostringstream text;
  text << stream.rdbuf();
  return std::move(text).str();
}

Status write_atomically(const fs::path& file, const std::function<Status(const fs::path&)>& write) {
  std::error_code code;
  if (const fs::path folder = file.parent_path(); !folder.empty()) fs::create_directories(folder, code);
  if (code)
    return error("{}: the folder cannot be made ({}); choose one that can be written",
                 file.parent_path().string(), code.message());
  const fs::path temporary = file.parent_path() / (".partial-" + file.filename().string());
  Status status = write(temporary);
  if (status) {
    fs::rename(temporary, file, code);
    if (code) status = error("{}: cannot be written ({})", file.string(), code.message());
  }
  if (!status) fs::remove(temporary, code);
  return status;
}

Status write_file(const fs::path& file, std::string_view text) {
  return write_atomically(file, [&](const fs::path& temporary) -> Status {
    std::ofstream stream(temporary, std::ios::binary);
    stream.write(text.data(), std::streamsize(text.size()));
    stream.close();
    if (!stream)
      return error("{}: cannot be written; is the folder writable and the disk not full?", file.string());
    return Done{};
  });
}

namespace {

bool is_below(const fs::path& path, const fs::path& folder) {
  const fs::path relative = path.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

Roots::Roots(fs::path scene_folder, std::vector<fs::path> data_folders) {
  folders_.push_back(scene_folder.empty() ? fs::path(".") : std::move(scene_folder));
  folders_.insert(folders_.end(), data_folders.begin(), data_folders.end());
  std::error_code code;
  for (fs::path& folder : folders_) folder = fs::weakly_canonical(folder, code);
}

Result<fs::path> Roots::find(const std::string& name, const FileLocation& where) const {
  bool leads_out = true;
  for (const fs::path& folder : folders_) {
    std::error_code code;
    const fs::path path = fs::weakly_canonical(folder / name, code);
    if (code || !is_below(path, folder)) continue;
    leads_out = false;
    if (fs::exists(path, code)) return path;
  }
  if (leads_out)
    return error_at(
        where, "\"{}\" leads out of the scene's folder; keep files below it or name their root with --data",
        name);
  return error_at(where, "there is no file \"{}\" in the scene's folder ({}) or a --data folder", name,
                  scene_folder().string());
}

}  // namespace parvis
