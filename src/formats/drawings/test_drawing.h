// DXF files written by hand, for tests: each value stands in the test.
#pragma once

#include <fmt/format.h>

#include <string>

namespace parvis::formats {

/// A file of one line of group codes and values, "0 LINE|8 WALLS|10 1|20 2|11 3|21 4", in its sections.
struct TestDrawing {
  std::string header = "9 $ACADVER|1 AC1015|9 $INSUNITS|70 6";
  std::string layers;
  std::string blocks;
  std::string entities;

  /// Each group as two lines.
  static std::string in_lines(const std::string& groups) {
    std::string text;
    for (std::size_t at = 0; at < groups.size();) {
      const std::size_t end = std::min(groups.find('|', at), groups.size());
      const std::string group = groups.substr(at, end - at);
      const std::size_t space = group.find(' ');
      text +=
          group.substr(0, space) + "\n" + (space == std::string::npos ? "" : group.substr(space + 1)) + "\n";
      at = end + 1;
    }
    return text;
  }

  std::string text() const {
    const auto section = [](const std::string& name, const std::string& groups) {
      return in_lines("0 SECTION|2 " + name + "|" + groups + (groups.empty() ? "" : "|") + "0 ENDSEC|");
    };
    return section("HEADER", header) +
           section("TABLES", "0 TABLE|2 LAYER|" + layers + (layers.empty() ? "" : "|") + "0 ENDTAB") +
           section("BLOCKS", blocks) + section("ENTITIES", entities) + in_lines("0 EOF");
  }
};

}  // namespace parvis::formats
