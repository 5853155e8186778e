#include "base/sealed_file.h"

#include <cassert>
#include <cstring>

#include "base/content_hash.h"
#include "base/files.h"

namespace parvis {
namespace {

constexpr std::size_t magic_size = 8;

std::uint64_t checksum(std::string_view bytes) {
  ContentHash hash;
  hash.add_text(bytes);
  return hash.value();
}

}  // namespace

Status write_sealed(const std::filesystem::path& file, const SealedKind& kind, std::string_view content) {
  return write_file(file, sealed_bytes(kind, content));
}

std::string sealed_bytes(const SealedKind& kind, std::string_view content) {
  assert(kind.magic.size() == magic_size);
  std::string bytes(kind.magic);
  bytes += content;
  append_value(bytes, checksum(bytes));
  return bytes;
}

Error cut_short(const std::filesystem::path& file) {
  return error("{}: is cut short or damaged", file.string());
}

Result<std::string> read_sealed(const std::filesystem::path& file, const SealedKind& kind) {
  const Result<std::string> bytes = read_file(file);
  if (!bytes) return bytes.errors();
  return opened_sealed(file, *bytes, kind);
}

Result<std::string> opened_sealed(const std::filesystem::path& file, std::string_view bytes,
                                  const SealedKind& kind) {
  if (!bytes.starts_with(kind.magic.substr(0, magic_size - 1)))
    return error("{}: is no {} of Parvis", file.string(), kind.name);
  if (!bytes.starts_with(kind.magic))
    return error("{}: is a {} of another version of Parvis ({}; this one reads {})", file.string(), kind.name,
                 bytes.substr(0, magic_size), kind.magic);
  std::uint64_t sum = 0;
  if (bytes.size() < magic_size + sizeof sum) return cut_short(file);
  const std::size_t end = bytes.size() - sizeof sum;
  std::memcpy(&sum, bytes.data() + end, sizeof sum);
  if (checksum(bytes.substr(0, end)) != sum) return cut_short(file);
  return std::string(bytes.substr(magic_size, end - magic_size));
}

std::string_view ByteReader::take_bytes(std::optional<std::uint64_t> size) {
  return take(size ? std::size_t(*size) : bytes_.size() + 1);
}

std::string_view ByteReader::take(std::size_t size) {
  if (size > bytes_.size()) {
    ended_early_ = true;
    return {};
  }
  const std::string_view part = bytes_.substr(0, size);
  bytes_.remove_prefix(size);
  return part;
}

}  // namespace parvis
