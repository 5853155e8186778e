#include "graphics/reference/photograph_checkpoint.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "base/content_hash.h"
#include "base/files.h"

namespace parvis::reference {
namespace {
namespace fs = std::filesystem;

constexpr char magic[8] = {'P', 'A', 'R', 'V', 'I', 'S', 'P', '2'};

struct Header {
  char magic[8];
  std::uint64_t key;
};

struct RecordHeader {
  std::uint32_t tile, values;
  std::uint64_t checksum;
};

/// The checksum includes the key: a tile of other work does not fit, whatever the header says.
std::uint64_t checksum(std::uint64_t key, std::uint32_t tile, std::span<const float> values) {
  ContentHash hash;
  hash.add(key), hash.add(tile);
  hash.add_bytes(values.data(), values.size_bytes());
  return hash.value();
}

/// Calls `found` for each whole record; returns the size of the part that is whole, 0 where nothing counts.
std::size_t read_records(const std::string& bytes, std::uint64_t key,
                         const std::function<void(std::uint32_t, std::span<const float>)>& found) {
  Header header{};
  if (bytes.size() < sizeof header) return 0;
  std::memcpy(&header, bytes.data(), sizeof header);
  if (std::memcmp(header.magic, magic, sizeof magic) != 0 || header.key != key) return 0;
  std::size_t at = sizeof header;
  std::vector<float> values;
  for (RecordHeader record{}; bytes.size() - at >= sizeof record;) {
    std::memcpy(&record, bytes.data() + at, sizeof record);
    const std::size_t size = std::size_t(record.values) * sizeof(float);
    if (bytes.size() - at - sizeof record < size) break;
    values.resize(record.values);
    if (size > 0) std::memcpy(values.data(), bytes.data() + at + sizeof record, size);
    if (checksum(key, record.tile, values) != record.checksum) break;
    found(record.tile, values);
    at += sizeof record + size;
  }
  return at;
}

/// Whether `bytes` may be replaced by work of `key`: they are its own, were cut short within the header, or
/// hold no tile yet; or they are tiles that may be lost.
Status check_owner(const fs::path& file, const std::string& bytes, std::uint64_t key, bool replaces) {
  Header header{};
  std::memcpy(&header, bytes.data(), std::min(bytes.size(), sizeof header));
  if (std::memcmp(header.magic, magic, std::min(bytes.size(), sizeof magic)) != 0)
    return error("{}: is no checkpoint of a photograph and is not replaced; choose another output",
                 file.string());
  if (bytes.size() <= sizeof header || header.key == key || replaces) return Ok{};
  return error(
      "{}: holds tiles of a photograph of another scene or with other settings; give the command of "
      "that one to go on with it, or --restart to lose them",
      file.string());
}

}  // namespace

Result<PhotographCheckpoint> PhotographCheckpoint::open(
    const fs::path& file, std::uint64_t key, bool replaces,
    const std::function<void(std::uint32_t, std::span<const float>)>& found) {
  std::error_code code;
  if (const fs::path folder = file.parent_path(); !folder.empty()) fs::create_directories(folder, code);
  const int descriptor = ::open(file.c_str(), O_CREAT | O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
  std::FILE* const stream = descriptor < 0 ? nullptr : fdopen(descriptor, "r+b");
  if (!stream) {
    if (descriptor >= 0) close(descriptor);
    return error("{}: cannot be written, or is a link; is the folder writable and the disk not full?",
                 file.string());
  }
  PhotographCheckpoint checkpoint(file, stream, key);
  const Result<std::string> bytes = read_file(file);
  if (!bytes) return bytes.errors();
  if (Status status = check_owner(file, *bytes, key, replaces); !status) return status.errors();
  const std::size_t kept = read_records(*bytes, key, [&](std::uint32_t tile, std::span<const float> values) {
    ++checkpoint.tiles_;
    found(tile, values);
  });
  if (ftruncate(descriptor, off_t(kept)) != 0 || std::fseek(stream, long(kept), SEEK_SET) != 0)
    return error("{}: cannot be written; is the disk full?", file.string());
  if (kept == 0) {
    Header header{};
    std::memcpy(header.magic, magic, sizeof magic);
    header.key = key;
    if (std::fwrite(&header, sizeof header, 1, stream) != 1 || std::fflush(stream) != 0)
      return error("{}: cannot be written; is the disk full?", file.string());
  }
  return checkpoint;
}

PhotographCheckpoint::PhotographCheckpoint(PhotographCheckpoint&& other) noexcept
    : file_(std::move(other.file_)),
      stream_(std::exchange(other.stream_, nullptr)),
      key_(other.key_),
      tiles_(other.tiles_) {}

PhotographCheckpoint::~PhotographCheckpoint() {
  if (stream_) std::fclose(stream_);
}

void PhotographCheckpoint::keep(std::uint32_t tile, std::span<const float> values) {
  const RecordHeader record{tile, std::uint32_t(values.size()), checksum(key_, tile, values)};
  const std::scoped_lock lock(mutex_);
  if (!stream_) return;
  const bool is_kept = std::fwrite(&record, sizeof record, 1, stream_) == 1 &&
                       std::fwrite(values.data(), sizeof(float), values.size(), stream_) == values.size() &&
                       std::fflush(stream_) == 0;
  if (is_kept) {
    ++tiles_;
    return;
  }
  // What follows a record that was cut short would not be read: this one was the last.
  std::fclose(std::exchange(stream_, nullptr));
}

}  // namespace parvis::reference
