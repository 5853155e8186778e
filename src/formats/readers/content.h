// What the files of a format begin with, for formats that are text of a known shape.
#pragma once

#include <string_view>

namespace parvis::formats {

/// The text without spaces and the mark of UTF-8 before it.
inline std::string_view without_blanks(std::string_view front) {
  const std::size_t first = front.find_first_not_of(" \t\r\n\x1e\xef\xbb\xbf");
  return first == std::string_view::npos ? std::string_view() : front.substr(first);
}

/// An object of JSON.
inline bool looks_like_json(std::string_view front) { return without_blanks(front).starts_with('{'); }

/// Any XML, in UTF-8 or UTF-16.
inline bool looks_like_xml(std::string_view front) {
  return without_blanks(front).starts_with('<') || front.starts_with("\xff\xfe") ||
         front.starts_with("\xfe\xff");
}

/// OpenStreetMap's binary form: the length of a first block, then that block's type.
inline bool looks_like_osm_pbf(std::string_view front) { return front.find("OSMHeader") == 6; }

}  // namespace parvis::formats
