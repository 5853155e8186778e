// A 64-bit hash of content: equal content, equal hash, on every machine of this byte order.
// For recognising one's own files again, not for safety.
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <vector>

namespace parvis {

class ContentHash {
 public:
  void add_bytes(const void* data, std::size_t size) {
    const unsigned char* bytes = static_cast<const unsigned char*>(data);
    mix(size);
    for (; size >= 8; bytes += 8, size -= 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes, 8);
      mix(word);
    }
    std::uint64_t rest = 0;
    if (size > 0) std::memcpy(&rest, bytes, size);  // `bytes` may be null then
    mix(rest);
  }

  /// Numbers, enums, vectors and matrices of them: types without padding.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void add(const T& value) { add_bytes(&value, sizeof value); }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void add(const std::vector<T>& values) { add_bytes(values.data(), values.size() * sizeof(T)); }
  void add_text(std::string_view text) { add_bytes(text.data(), text.size()); }

  std::uint64_t value() const { return state_ ^ (state_ >> 29); }

 private:
  void mix(std::uint64_t word) {
    state_ = (state_ ^ word) * 0x9e3779b97f4a7c15ull;
    state_ ^= state_ >> 32;
  }

  std::uint64_t state_ = 0x243f6a8885a308d3ull;
};

}  // namespace parvis
