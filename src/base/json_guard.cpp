#include "base/json_guard.h"

namespace parvis {

Status check_json_depth(std::string_view text, const std::string& subject) {
  int depth = 0;
  bool is_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_string) {
      if (c == '\\') ++i;  // whatever it is, it ends nothing
      is_string = c != '"';
    } else if (c == '"') {
      is_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > max_json_depth)
        return error("{}: lists and objects of its JSON stand more than {} deep in each other", subject,
                     max_json_depth);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return Ok{};
}

std::string json_reason(std::string_view what) {
  const std::size_t end = what.starts_with('[') ? what.find("] ") : std::string_view::npos;
  return std::string(end == std::string_view::npos ? what : what.substr(end + 2));
}

}  // namespace parvis
