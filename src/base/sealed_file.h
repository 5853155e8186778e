// Binary files that Parvis keeps for itself: 8 characters that name kind and version, numbers as they lie in
// memory (little-endian), a checksum of all before it. A file that was cut short, damaged or written by
// another version is reported, and never used.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/result.h"

namespace parvis {

/// Identifies one kind of sealed file and its version.
struct SealedKind {
  std::string_view magic;  ///< 8 characters, the last its version
  std::string_view name;   ///< as errors call it, "reference map"
};

/// Writes header, content and checksum; the file appears completely or not at all.
Status write_sealed(const std::filesystem::path& file, const SealedKind& kind, std::string_view content);

/// Returns the content. Errors say whether the file is missing, foreign, of another version, truncated or
/// damaged.
Result<std::string> read_sealed(const std::filesystem::path& file, const SealedKind& kind);
/// The bytes of such a file, for those that are kept within another file.
std::string sealed_bytes(const SealedKind& kind, std::string_view content);
/// The content of such bytes; errors as of read_sealed, under the name of `file`.
Result<std::string> opened_sealed(const std::filesystem::path& file, std::string_view bytes,
                                  const SealedKind& kind);
/// The error for a file whose content ends early, for readers that find so while they parse it.
Error cut_short(const std::filesystem::path& file);

/// Appends the bytes of a value as they lie in memory.
template <class T>
requires std::is_trivially_copyable_v<T>
void append_value(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Appends the number of values (32 bits), then the values.
template <class T>
requires std::is_trivially_copyable_v<T>
void append_values(std::string& bytes, const std::vector<T>& values) {
  append_value(bytes, std::uint32_t(values.size()));
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// Appends a text with its length.
inline void append_text(std::string& bytes, std::string_view text) {
  append_values(bytes, std::vector<char>(text.begin(), text.end()));
}

/// Reads values from the front of a byte string. Reading beyond the end yields zeros and sets
/// `has_ended_early`.
class ByteReader {
 public:
  /// `bytes` must outlive the reader.
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  /// The next value, as `append_value` has written it; zero beyond the end.
  template <class T>
  T take() {
    T value{};
    const std::string_view part = take(sizeof value);
    std::copy(part.begin(), part.end(), reinterpret_cast<char*>(&value));
    return value;
  }
  /// The next vector, as `append_values` has written it; empty beyond the end.
  template <class T>
  std::vector<T> take_values() {
    const std::size_t count = take<std::uint32_t>();
    const std::string_view part = take(count * sizeof(T));
    std::vector<T> values(part.size() / sizeof(T));
    std::copy(part.begin(), part.end(), reinterpret_cast<char*>(values.data()));
    return values;
  }
  /// The next text, as `append_text` has written it; empty beyond the end.
  std::string take_text() {
    const std::vector<char> text = take_values<char>();
    return {text.begin(), text.end()};
  }
  /// The next `size` bytes; none of them, as beyond the end, where there are fewer or `size` is none.
  std::string_view take_bytes(std::optional<std::uint64_t> size);
  /// All that has not been read yet.
  std::string_view rest() const { return bytes_; }
  /// True if everything has been read and nothing was missing.
  bool is_at_end() const { return bytes_.empty() && !ended_early_; }
  /// True if more was asked for than there was.
  bool has_ended_early() const { return ended_early_; }

 private:
  std::string_view take(std::size_t size);

  std::string_view bytes_;
  bool ended_early_ = false;
};

}  // namespace parvis
