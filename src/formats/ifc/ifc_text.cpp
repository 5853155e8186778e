#include "formats/ifc/ifc_text.h"

#include <cstdint>

namespace parvis::scene {

std::string utf8(const std::wstring& text) {
  std::string bytes;
  for (const wchar_t letter : text) {
    const std::uint32_t code = std::char_traits<wchar_t>::to_int_type(letter);
    const auto tail = [&](int shift) { bytes += char(0x80 | ((code >> shift) & 0x3f)); };
    if (code < 0x80) {
      bytes += char(code);
    } else if (code < 0x800) {
      bytes += char(0xc0 | (code >> 6)), tail(0);
    } else if (code < 0x10000) {
      bytes += char(0xe0 | (code >> 12)), tail(6), tail(0);
    } else {
      bytes += char(0xf0 | ((code >> 18) & 7)), tail(12), tail(6), tail(0);
    }
  }
  return bytes;
}

}  // namespace parvis::scene
