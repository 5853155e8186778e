#include "base/radiance_header.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>

namespace parvis {
namespace {

constexpr std::size_t max_header_bytes = 65536;

/// Divides by values that are numbers above 0.
void divide(RadianceHeader& header, const std::array<float, 3>& by) {
  for (std::size_t c = 0; c < 3; ++c)
    if (by[c] > 0.0f && std::isfinite(by[c])) header.scale[c] /= by[c];
}

/// "-Y 512 +X 1024": the axis from line to line, then the one along a line.
void read_order(const std::string& line, RadianceHeader& header) {
  std::array<char, 2> sign{}, axis{};
  std::array<int, 2> size{};
  if (std::sscanf(line.c_str(), " %c%c %d %c%c %d", &sign[0], &axis[0], &size[0], &sign[1], &axis[1],
                  &size[1]) != 6)
    return;
  for (std::size_t i = 0; i < 2; ++i) {
    if (axis[i] == 'X') header.starts_right = sign[i] == '-';
    if (axis[i] == 'Y') header.starts_below = sign[i] == '+';
  }
  header.is_transposed = axis[0] == 'X';
}

}  // namespace

RadianceHeader radiance_header(std::span<const std::uint8_t> bytes) {
  RadianceHeader header;
  std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                        std::min(bytes.size(), max_header_bytes));
  bool is_last = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (is_last) {
      read_order(line, header);
      break;
    }
    is_last = line.empty() || line == "\r";
    std::array<float, 3> value{};
    if (std::sscanf(line.c_str(), "EXPOSURE= %f", &value[0]) == 1)
      divide(header, {value[0], value[0], value[0]});
    if (std::sscanf(line.c_str(), "COLORCORR= %f %f %f", &value[0], &value[1], &value[2]) == 3)
      divide(header, value);
  }
  return header;
}

}  // namespace parvis
