#include "base/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>

#include "base/exception_reason.h"
#include "base/file_front.h"
#include "base/memory_budget.h"
#include "base/partial_file.h"
#include "base/path_inside.h"

namespace parvis {
namespace fs = std::filesystem;

namespace {

/// A file descriptor, closed at the end.
class OpenFile {
 public:
  OpenFile(const fs::path& file, int flags, mode_t mode = 0)
      : descriptor_(open(file.c_str(), flags | O_CLOEXEC, mode)) {}
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  explicit operator bool() const { return descriptor_ >= 0; }
  int get() const { return descriptor_; }
  /// False where bytes written before turn out to be lost.
  bool close() { return ::close(std::exchange(descriptor_, -1)) == 0; }

 private:
  int descriptor_;
};

/// Appends up to `count` bytes; false if reading fails.
bool read_some(int file, std::string& text, std::size_t count) {
  const std::size_t before = text.size();
  text.resize(before + count);
  ssize_t got = 0;
  do got = read(file, text.data() + before, count);
  while (got < 0 && errno == EINTR);
  text.resize(before + std::size_t(std::max<ssize_t>(got, 0)));
  return got >= 0;
}

}  // namespace

namespace {

/// Whether the file is open, and a regular one.
Status check_opened(const OpenFile& opened, const fs::path& file, struct stat& status) {
  if (!opened) return error("{}: cannot be opened for reading ({})", file.string(), system_reason());
  if (fstat(opened.get(), &status) != 0 || !S_ISREG(status.st_mode))
    return error("{}: is not a regular file; expected one, no folder, pipe or device", file.string());
  return Ok{};
}

/// A pipe without a writer is refused by `check_opened`, not waited for.
constexpr int to_read = O_RDONLY | O_NONBLOCK;

}  // namespace

Result<std::string> read_front(const fs::path& file, std::size_t count) {
  const OpenFile opened(file, to_read);
  struct stat status {};
  if (Status checked = check_opened(opened, file, status); !checked) return checked.errors();
  std::string text;
  for (std::size_t before = std::size_t(-1); before != text.size() && text.size() < count;) {
    before = text.size();
    if (!read_some(opened.get(), text, count - before))
      return error("{}: cannot be read ({})", file.string(), system_reason());
  }
  return text;
}

Result<std::string> read_file(const fs::path& file, std::uint64_t max_bytes) {
  const OpenFile opened(file, to_read);
  struct stat status {};
  if (Status checked = check_opened(opened, file, status); !checked) return checked.errors();
  const Error too_large =
      error("{}: is larger than the {:.1f} MB that are read", file.string(), double(max_bytes) / 1e6);
  if (std::uint64_t(status.st_size) > max_bytes) return too_large;
  if (Status enough = check_memory(std::uint64_t(status.st_size), file.string()); !enough)
    return enough.errors();
  std::string text;
  text.reserve(std::size_t(status.st_size) + 1);
  // Files of /proc and those that grow have another size than they say: read to the end, one byte beyond the
  // limit.
  constexpr std::size_t piece = std::size_t{1} << 20;
  for (std::size_t before = std::size_t(-1); before != text.size();) {
    before = text.size();
    const std::uint64_t left = max_bytes + 1 - before;
    const std::size_t expected =
        std::max(std::size_t(status.st_size) + 1 - std::min(before, std::size_t(status.st_size)), piece);
    if (!read_some(opened.get(), text,
                   std::size_t(std::min<std::uint64_t>(left, before == 0 ? expected : piece))))
      return error("{}: cannot be read ({})", file.string(), system_reason());
    if (text.size() > max_bytes) return too_large;
  }
  return text;
}

Status write_atomically(const fs::path& file, const std::function<Status(const fs::path&)>& write) {
  Result<PartialFile> partial = PartialFile::create(file);
  if (!partial) return partial.errors();
  if (Status status = write(partial->path()); !status) return status;
  return partial->keep();
}

Status write_file(const fs::path& file, std::string_view text) {
  Result<PartialFile> partial = PartialFile::create(file);
  if (!partial) return partial.errors();
  if (Status status = partial->write(text); !status) return status;
  return partial->keep();
}

Roots::Roots(fs::path scene_folder, std::vector<fs::path> data_folders) {
  folders_.push_back(scene_folder.empty() ? fs::path(".") : std::move(scene_folder));
  folders_.insert(folders_.end(), data_folders.begin(), data_folders.end());
  std::error_code code;
  for (fs::path& folder : folders_) folder = fs::weakly_canonical(folder, code);
}

Result<fs::path> Roots::find(const std::string& name, const FileLocation& where) const {
  bool leads_out = true;
  std::error_code problem;
  for (const fs::path& folder : folders_) {
    std::error_code code;
    const fs::path path = fs::weakly_canonical(folder / name, code);
    if (code) problem = code;
    if (code || !is_below(path, folder)) continue;
    leads_out = false;
    const fs::file_type type = fs::status(path, code).type();
    if (type == fs::file_type::regular || type == fs::file_type::directory) return path;
    if (fs::exists(fs::file_status(type)))
      return error_at(where, "\"{}\" is neither a file nor a folder", name);
  }
  if (leads_out && problem)
    return error_at(where, "\"{}\" cannot be looked for in the scene's folder ({}); put the file there", name,
                    problem.message());
  if (leads_out)
    return error_at(
        where, "\"{}\" leads out of the scene's folder; keep files below it or name their root with --data",
        name);
  return error_at(where,
                  "there is no file \"{}\" in the scene's folder ({}) or a --data folder; put it there, or "
                  "take out what names it",
                  name, scene_folder().string());
}

}  // namespace parvis
