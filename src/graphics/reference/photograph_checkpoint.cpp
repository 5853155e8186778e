#include "graphics/reference/photograph_checkpoint.h"

#include <cstring>

#include "base/content_hash.h"
#include "base/files.h"

namespace parvis::reference {
namespace {
namespace fs = std::filesystem;

constexpr char magic[8] = {'P', 'A', 'R', 'V', 'I', 'S', 'P', '1'};

struct Header {
  char magic[8];
  std::uint64_t key;
};

struct RecordHeader {
  std::uint32_t tile, values;
  std::uint64_t checksum;
};

std::uint64_t checksum(std::uint32_t tile, std::span<const float> values) {
  ContentHash hash;
  hash.add(tile);
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
    if (checksum(record.tile, values) != record.checksum) break;
    found(record.tile, values);
    at += sizeof record + size;
  }
  return at;
}

}  // namespace

Result<PhotographCheckpoint> PhotographCheckpoint::open(
    const fs::path& file, std::uint64_t key,
    const std::function<void(std::uint32_t, std::span<const float>)>& found) {
  std::error_code code;
  if (const fs::path folder = file.parent_path(); !folder.empty()) fs::create_directories(folder, code);
  std::size_t kept = 0;
  if (fs::exists(file, code))
    if (const Result<std::string> bytes = read_file(file)) kept = read_records(*bytes, key, found);
  if (kept > 0) fs::resize_file(file, kept, code);
  std::FILE* stream = std::fopen(file.c_str(), kept > 0 && !code ? "ab" : "wb");
  if (!stream)
    return error("{}: cannot be written; is the folder writable and the disk not full?", file.string());
  PhotographCheckpoint checkpoint(file, stream);
  if (kept == 0) {
    Header header{};
    std::memcpy(header.magic, magic, sizeof magic);
    header.key = key;
    std::fwrite(&header, sizeof header, 1, stream);
  }
  return checkpoint;
}

PhotographCheckpoint::PhotographCheckpoint(PhotographCheckpoint&& other) noexcept
    : file_(std::move(other.file_)), stream_(std::exchange(other.stream_, nullptr)) {}

PhotographCheckpoint::~PhotographCheckpoint() {
  if (stream_) std::fclose(stream_);
}

void PhotographCheckpoint::keep(std::uint32_t tile, std::span<const float> values) {
  const RecordHeader record{tile, std::uint32_t(values.size()), checksum(tile, values)};
  const std::scoped_lock lock(mutex_);
  std::fwrite(&record, sizeof record, 1, stream_);
  std::fwrite(values.data(), sizeof(float), values.size(), stream_);
  std::fflush(stream_);
}

}  // namespace parvis::reference
