#include "formats/drawings/drawing_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "base/utf8.h"

namespace parvis::formats {
namespace {

/// Windows' code page 1252 from 0x80 to 0x9f; all else is as in Unicode. 0: no character.
constexpr std::array<char16_t, 32> code_page_1252{
    0x20ac, 0,      0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0x02c6, 0x2030, 0x0160,
    0x2039, 0x0152, 0,      0x017d, 0,      0,      0x2018, 0x2019, 0x201c, 0x201d, 0x2022,
    0x2013, 0x2014, 0x02dc, 0x2122, 0x0161, 0x203a, 0x0153, 0,      0x017e, 0x0178};

constexpr char32_t replacement = 0xfffd;

void append_utf8(std::string& text, char32_t code) {
  if (code < 0x20) code = ' ';
  if ((code >= 0xd800 && code < 0xe000) || code > 0x10ffff) code = replacement;
  if (code < 0x80) {
    text += char(code);
  } else if (code < 0x800) {
    text += char(0xc0 | (code >> 6)), text += char(0x80 | (code & 0x3f));
  } else if (code < 0x10000) {
    text += char(0xe0 | (code >> 12)), text += char(0x80 | ((code >> 6) & 0x3f));
    text += char(0x80 | (code & 0x3f));
  } else {
    text += char(0xf0 | (code >> 18)), text += char(0x80 | ((code >> 12) & 0x3f));
    text += char(0x80 | ((code >> 6) & 0x3f)), text += char(0x80 | (code & 0x3f));
  }
}

bool is_ascii(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

std::string from_1252(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_listed = byte >= 0x80 && byte < 0xa0;
    const char32_t code = is_listed ? code_page_1252[byte - 0x80u] : byte;
    append_utf8(text, code == 0 && is_listed ? replacement : code);
  }
  return text;
}

/// The code of \U+XXXX at the front of `text`.
std::optional<char32_t> written_code(std::string_view text) {
  constexpr std::size_t length = 7;
  if (text.size() < length || !(text.starts_with("\\U+") || text.starts_with("\\u+"))) return std::nullopt;
  unsigned code = 0;
  const char* const end = text.data() + length;
  const auto [stopped, error] = std::from_chars(text.data() + 3, end, code, 16);
  if (error != std::errc() || stopped != end) return std::nullopt;
  return char32_t(code);
}

std::string without_written_codes(std::string_view text) {
  constexpr std::size_t length = 7;
  std::string result;
  while (!text.empty()) {
    std::optional<char32_t> code = written_code(text);
    if (!code) {
      result += text.front();
      text.remove_prefix(1);
      continue;
    }
    text.remove_prefix(length);
    const bool is_high = *code >= 0xd800 && *code < 0xdc00;
    if (const auto low = is_high ? written_code(text) : std::nullopt;
        low && *low >= 0xdc00 && *low < 0xe000) {
      code = 0x10000 + ((*code - 0xd800) << 10) + (*low - 0xdc00);
      text.remove_prefix(length);
    }
    append_utf8(result, *code);
  }
  return result;
}

}  // namespace

std::string decoded(std::string_view value) {
  const std::string text = is_utf8(value) ? std::string(value) : from_1252(value);
  return text.find("\\U+") == std::string::npos && text.find("\\u+") == std::string::npos
             ? text
             : without_written_codes(text);
}

void decode_texts(GroupCodes& codes, std::string_view code_page, const std::string& file, Errors& warnings) {
  bool has_bytes = false;
  for (std::size_t i = 0; i < codes.groups.size(); ++i) {
    const std::string_view value = codes.groups[i].value;
    const bool is_plain = is_ascii(value);
    if (is_plain && value.find("U+") == std::string_view::npos && value.find("u+") == std::string_view::npos)
      continue;
    has_bytes = has_bytes || !is_utf8(value);
    replace_value(codes, i, decoded(value));
  }
  const bool is_latin = code_page.empty() || code_page == "ANSI_1252" || code_page == "ISO8859-1" ||
                        code_page == "iso8859-1" || code_page == "ascii";
  if (has_bytes && !is_latin)
    warnings.push_back(
        {fmt::format("its texts are of the code page {}, which is read as ANSI_1252: accents "
                     "in names of layers and blocks may be wrong; save it as DXF 2007 or later",
                     code_page.substr(0, 40)),
         {file, 0, 0}});
}

}  // namespace parvis::formats
