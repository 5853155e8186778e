#include "capture/trees/checkpoint.h"

#include <vector>

#include "base/file_front.h"
#include "base/sealed_file.h"

namespace parvis::trees {
namespace {
namespace fs = std::filesystem;

constexpr SealedKind kind{"PVPART_1", "part of a tree"};
constexpr std::string_view extension = ".part";

bool is_link(const fs::path& path) {
  std::error_code code;
  return fs::is_symlink(fs::symlink_status(path, code));
}

/// Whether what lies at `file` may be replaced: nothing, or a part.
Status check_place(const fs::path& folder, const fs::path& file) {
  for (const fs::path& place : {folder, file})
    if (is_link(place))
      return error("{}: is a link; nothing is kept there. Remove it, or choose another output",
                   place.string());
  std::error_code code;
  if (!fs::exists(file, code)) return Done{};
  const Result<std::string> front = read_front(file, kind.magic.size());
  if (!front) return front.errors();
  // A program that was killed may have left an empty one; versions differ in the last character.
  if (!front->empty() && !front->starts_with(kind.magic.substr(0, kind.magic.size() - 1)))
    return error("{}: is no {} and is not replaced; choose another output", file.string(), kind.name);
  return Done{};
}

}  // namespace

fs::path Checkpoint::file(const std::string& part) const { return folder_ / (part + std::string(extension)); }

std::optional<std::string> Checkpoint::find(const std::string& part, std::uint64_t key) const {
  std::error_code code;
  const fs::path path = file(part);
  if (folder_.empty() || is_link(folder_) || is_link(path) || !fs::exists(path, code)) return std::nullopt;
  const Result<std::string> content = read_sealed(path, kind);
  if (!content) {
    fmt::print(stderr, "warning: {}; this part is computed again\n", content.errors().front().message);
    return std::nullopt;
  }
  Taker taker(*content);
  if (taker.take<std::uint64_t>() != key) return std::nullopt;
  return std::string(taker.rest());
}

Status Checkpoint::keep(const std::string& part, std::uint64_t key, std::string_view content) const {
  if (folder_.empty()) return Done{};
  const fs::path path = file(part);
  if (Status status = check_place(folder_, path); !status) return status;
  std::string bytes;
  bytes.reserve(sizeof key + content.size());
  append_value(bytes, key);
  bytes += content;
  return write_sealed(path, kind, bytes);
}

void Checkpoint::remove() const {
  if (folder_.empty() || is_link(folder_)) return;
  std::error_code code;
  std::vector<fs::path> parts;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, code))
    if (entry.path().extension() == extension && check_place(folder_, entry.path()))
      parts.push_back(entry.path());
  for (const fs::path& part : parts) fs::remove(part, code);
  fs::remove(folder_, code);
}

}  // namespace parvis::trees
