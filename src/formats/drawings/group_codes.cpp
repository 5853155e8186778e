#include "formats/drawings/group_codes.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

namespace parvis::formats {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view binary_mark = "AutoCAD Binary DXF\r\n\x1a\0"sv;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::optional<int> code_in(std::string_view text) {
  text = trimmed(text);
  int code = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), code);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return code;
}

/// Takes a line off the front, without its end.
std::string_view take_line(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

Error cut_error(const std::string& file, int line, std::string_view section) {
  return error_at({file, line, 0},
                  "the drawing ends here{}{}, without EOF: the file was cut; copy it again, or save it again "
                  "as DXF",
                  section.empty() ? "" : " within the section ", section);
}

/// The name of the section that the last groups stand in; empty between sections.
std::string_view section_at_end(const std::vector<Group>& groups) {
  for (std::size_t i = groups.size(); i-- > 0;) {
    if (groups[i].code != 0) continue;
    if (groups[i].value == "ENDSEC") return {};
    if (groups[i].value == "SECTION" && i + 1 < groups.size()) return groups[i + 1].value;
  }
  return {};
}

Result<GroupCodes> text_groups(std::string_view bytes, const std::string& file) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  GroupCodes codes;
  codes.groups.reserve(bytes.size() / 12);
  int line = 0;
  while (!bytes.empty()) {
    const std::string_view first = take_line(bytes);
    ++line;
    const std::optional<int> code = code_in(first);
    if (!code && trimmed(first).empty() && bytes.empty()) break;
    if (!code)
      return error_at({file, line, 0},
                      "\"{}\" is no group code; expected a number: the file is no DXF, or was damaged here",
                      first.substr(0, 40));
    if (bytes.empty()) return cut_error(file, line, section_at_end(codes.groups));
    const std::string_view value = take_line(bytes);
    ++line;
    const bool is_name = *code == 0 || *code == 5 || *code == 9;
    codes.groups.push_back({*code, is_name ? trimmed(value) : value, line});
    if (*code == 0 && codes.groups.back().value == "EOF") return codes;
  }
  return cut_error(file, line, section_at_end(codes.groups));
}

/// How the binary form stores the value of a group.
enum class Stored : unsigned char { text, real, int16, int32, int64, boolean, chunk };

Stored stored_as(int code) {
  struct Range {
    int first, last;
    Stored stored;
  };
  static constexpr Range ranges[]{
      {10, 59, Stored::real},      {60, 79, Stored::int16},    {90, 99, Stored::int32},
      {110, 149, Stored::real},    {160, 169, Stored::int64},  {170, 179, Stored::int16},
      {210, 239, Stored::real},    {270, 289, Stored::int16},  {290, 299, Stored::boolean},
      {310, 319, Stored::chunk},   {370, 389, Stored::int16},  {400, 409, Stored::int16},
      {420, 429, Stored::int32},   {440, 459, Stored::int32},  {460, 469, Stored::real},
      {1004, 1004, Stored::chunk}, {1010, 1059, Stored::real}, {1060, 1070, Stored::int16},
      {1071, 1071, Stored::int32}};
  for (const Range& range : ranges)
    if (code >= range.first && code <= range.last) return range.stored;
  return Stored::text;
}

/// Takes little-endian values off the front of the bytes.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : rest_(bytes) {}
  bool empty() const { return rest_.empty(); }
  char front() const { return rest_.front(); }

  template <class T>
  std::optional<T> take() {
    if (rest_.size() < sizeof(T)) return std::nullopt;
    T value;
    std::memcpy(&value, rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    return value;
  }
  std::optional<std::string_view> take_text() {
    const std::size_t end = rest_.find('\0');
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view text = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return text;
  }
  std::optional<std::string_view> take_bytes(std::size_t count) {
    if (rest_.size() < count) return std::nullopt;
    const std::string_view bytes = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return bytes;
  }

 private:
  std::string_view rest_;
};

template <class T>
std::optional<std::string> number_text(Bytes& bytes) {
  const std::optional<T> value = bytes.take<T>();
  if (!value) return std::nullopt;
  return fmt::format("{}", *value);
}

std::optional<std::string> number_text(Bytes& bytes, Stored stored) {
  switch (stored) {
    case Stored::real:
      return number_text<double>(bytes);
    case Stored::int16:
      return number_text<std::int16_t>(bytes);
    case Stored::int32:
      return number_text<std::int32_t>(bytes);
    case Stored::int64:
      return number_text<std::int64_t>(bytes);
    case Stored::boolean: {
      const std::optional<unsigned char> value = bytes.take<unsigned char>();
      return value ? std::optional<std::string>(*value ? "1" : "0") : std::nullopt;
    }
    default: {
      const std::optional<unsigned char> size = bytes.take<unsigned char>();
      const auto content = size ? bytes.take_bytes(*size) : std::nullopt;
      if (!content) return std::nullopt;
      std::string digits;
      for (const char byte : *content) digits += fmt::format("{:02X}", static_cast<unsigned char>(byte));
      return digits;
    }
  }
}

/// A code has two bytes; before AC1012 it has one, and 255 says that two follow.
std::optional<int> take_code(Bytes& bytes, bool has_short_codes) {
  if (has_short_codes) {
    const std::optional<unsigned char> code = bytes.take<unsigned char>();
    if (!code || *code != 255) return code ? std::optional<int>(*code) : std::nullopt;
  }
  const std::optional<std::int16_t> code = bytes.take<std::int16_t>();
  return code ? std::optional<int>(*code) : std::nullopt;
}

Result<GroupCodes> binary_groups(std::string_view all, const std::string& file) {
  all.remove_prefix(binary_mark.size());
  const bool has_short_codes = all.size() > 1 && all[1] != '\0';  // the first group is 0, SECTION
  Bytes bytes(all);
  GroupCodes codes;
  codes.is_binary = true;
  while (!bytes.empty()) {
    const int number = int(codes.groups.size()) + 1;
    const std::optional<int> code = take_code(bytes, has_short_codes);
    if (!code) break;
    const Stored stored = stored_as(*code);
    if (stored == Stored::text) {
      const std::optional<std::string_view> text = bytes.take_text();
      if (!text) break;
      codes.groups.push_back({*code, *text, number});
      if (*code == 0 && *text == "EOF") return codes;
    } else {
      std::optional<std::string> text = number_text(bytes, stored);
      if (!text) break;
      codes.made.push_back(*std::move(text));
      codes.groups.push_back({*code, codes.made.back(), number});
    }
  }
  return cut_error(file, 0, section_at_end(codes.groups));
}

}  // namespace

bool looks_like_dxf(std::string_view front) {
  if (front.starts_with(binary_mark.substr(0, 18))) return true;
  if (front.starts_with("\xef\xbb\xbf")) front.remove_prefix(3);
  // Comments (999) may stand before the first section.
  for (int group = 0; group < 50 && !front.empty(); ++group) {
    const std::optional<int> code = code_in(take_line(front));
    const std::string_view value = trimmed(take_line(front));
    if (code == 0) return value == "SECTION" || value == "EOF";
    if (code != 999) return false;
  }
  return false;
}

Result<GroupCodes> group_codes(std::string_view bytes, const std::string& file) {
  if (bytes.starts_with(binary_mark)) return binary_groups(bytes, file);
  if (looks_like_dxf(bytes)) return text_groups(bytes, file);
  if (bytes.starts_with("AC10"))
    return error_at({file, 0, 0}, "this is a DWG file; save it as DXF (AutoCAD 2000 or later)");
  return error_at({file, 0, 0}, "this is no DXF file: expected 0, SECTION in its first lines");
}

void replace_value(GroupCodes& codes, std::size_t group, std::string text) {
  codes.made.push_back(std::move(text));
  codes.groups[group].value = codes.made.back();
}

std::string as_text(const GroupCodes& codes) {
  std::string text;
  std::size_t size = 0;
  for (const Group& group : codes.groups) size += group.value.size() + 8;
  text.reserve(size);
  for (const Group& group : codes.groups) {
    fmt::format_to(std::back_inserter(text), "{:3}\n", group.code);
    // A line's end inside of a value (of a binary file) would shift all groups after it.
    for (const char c : group.value) text += c == '\n' || c == '\r' || c == '\0' ? ' ' : c;
    text += '\n';
  }
  return text;
}

double number_of(std::string_view value, double fallback) {
  value = trimmed(value);
  if (value.starts_with('+')) value.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  return error == std::errc() && std::isfinite(number) ? number : fallback;
}

int integer_of(std::string_view value, int fallback) {
  value = trimmed(value);
  int number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  return error == std::errc() ? number : fallback;
}

}  // namespace parvis::formats
