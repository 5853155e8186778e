// Expat counts bytes in int: long texts are parsed in pieces.
#pragma once

#include <expat.h>

#include <algorithm>
#include <string_view>

namespace parvis::scene {

/// Gives the whole text to a parser, whose handlers are set. False: the text is not well-formed, and the
/// parser knows where.
inline bool parse_in_pieces(XML_Parser parser, std::string_view xml) {
  constexpr std::size_t piece = 1 << 20;
  for (std::size_t at = 0; at == 0 || at < xml.size(); at += piece) {
    const std::size_t length = std::min(piece, xml.size() - at);
    if (XML_Parse(parser, xml.data() + at, int(length), at + length == xml.size()) != XML_STATUS_OK)
      return false;
  }
  return true;
}

}  // namespace parvis::scene
