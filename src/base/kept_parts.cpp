#include "base/kept_parts.h"

#include <vector>

#include "base/file_front.h"
#include "base/partial_file.h"

namespace parvis {
namespace {
namespace fs = std::filesystem;

bool is_link(const fs::path& path) {
  std::error_code code;
  return fs::is_symlink(fs::symlink_status(path, code));
}

/// Whether another process is writing the file: its name is hidden until then, and no part's name is.
bool is_being_written(const fs::path& file) {
  return file.filename().string().starts_with('.') && !is_abandoned(file);
}

/// Checks that what lies at `file` may be replaced: nothing, a part of this kind or, in a folder of the
/// program's, any file.
Status check_place(const fs::path& folder, const fs::path& file, const SealedKind& kind, FolderOf owner) {
  for (const fs::path& place : {folder, file})
    if (is_link(place))
      return error("{}: is a link; nothing is stored there. Remove it, or choose another output",
                   place.string());
  std::error_code code;
  if (owner == FolderOf::program || !fs::exists(file, code)) return Ok{};
  const Result<std::string> front = read_front(file, kind.magic.size());
  if (!front) return front.errors();
  // A program that was killed may have left an empty one; versions differ in the last character.
  if (!front->empty() && !front->starts_with(kind.magic.substr(0, kind.magic.size() - 1)))
    return error("{}: is no {} and is not replaced; remove it, or choose another output", file.string(),
                 kind.name);
  return Ok{};
}

}  // namespace

fs::path KeptParts::file(const std::string& part) const {
  return keeps_parts() ? folder_ / (part + std::string(extension_)) : fs::path();
}

std::optional<std::string> KeptParts::find(const std::string& part, std::uint64_t key,
                                           std::string_view consequence) const {
  const auto refuse = [&](const Error& reason) {
    fmt::print(stderr, "warning: {}; {}\n", reason.message, consequence);
    return std::nullopt;
  };
  std::error_code code;
  const fs::path path = file(part);
  if (!keeps_parts() || is_link(folder_)) return std::nullopt;
  if (is_link(path)) return refuse(error("{}: is a link, which is not followed", path.string()));
  if (!fs::exists(path, code)) return std::nullopt;
  const Result<std::string> content = read_sealed(path, kind_);
  if (!content) return refuse(content.errors().front());
  ByteReader reader(*content);
  if (reader.take<std::uint64_t>() != key) return std::nullopt;
  return std::string(reader.rest());
}

Status KeptParts::keep(const std::string& part, std::uint64_t key, std::string_view content) const {
  if (!keeps_parts()) return Ok{};
  const fs::path path = file(part);
  if (Status status = check_place(folder_, path, kind_, owner_); !status) return status;
  std::string bytes;
  bytes.reserve(sizeof key + content.size());
  append_value(bytes, key);
  bytes += content;
  return write_sealed(path, kind_, bytes);
}

void KeptParts::remove(const std::set<fs::path>& kept) const {
  if (!keeps_parts() || is_link(folder_)) return;
  std::error_code code;
  std::vector<fs::path> parts;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, code))
    if (entry.path().extension() == extension_ && !is_being_written(entry.path()) &&
        !kept.contains(entry.path()) && check_place(folder_, entry.path(), kind_, owner_))
      parts.push_back(entry.path());
  for (const fs::path& part : parts) fs::remove(part, code);
  fs::remove(folder_, code);  // fails where something else lies in it
}

}  // namespace parvis
