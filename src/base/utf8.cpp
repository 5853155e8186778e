#include "base/utf8.h"

#include <cstdint>

namespace parvis {
namespace {

/// Length in bytes of the character that `text` begins with (RFC 3629, section 4); 0 where it is none.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? std::uint8_t(text[i]) : std::uint8_t(0); };
  const auto is_tail = [&](std::size_t i, int low = 0x80, int high = 0xbf) {
    return byte(i) >= low && byte(i) <= high;
  };
  const int first = byte(0);
  if (first < 0x80) return 1;
  if (first < 0xc2) return 0;
  if (first < 0xe0) return is_tail(1) ? 2 : 0;
  if (first < 0xf0) {
    const int low = first == 0xe0 ? 0xa0 : 0x80, high = first == 0xed ? 0x9f : 0xbf;
    return is_tail(1, low, high) && is_tail(2) ? 3 : 0;
  }
  if (first > 0xf4) return 0;
  const int low = first == 0xf0 ? 0x90 : 0x80, high = first == 0xf4 ? 0x8f : 0xbf;
  return is_tail(1, low, high) && is_tail(2) && is_tail(3) ? 4 : 0;
}

}  // namespace

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

void repair_utf8(std::string& text) {
  if (is_utf8(text)) return;
  constexpr std::string_view replacement = "\xef\xbf\xbd";
  std::string repaired;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t length = character_length(rest);
    repaired += length == 0 ? replacement : rest.substr(0, length);
    rest.remove_prefix(length == 0 ? 1 : length);
  }
  text = std::move(repaired);
}

}  // namespace parvis
