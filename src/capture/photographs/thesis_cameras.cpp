// The thesis's cameras (appendix A.1): camera="x y z h p r fov aspect", each after the file="..." that it
// belongs to.
//
// Position in metres; then Euler angles in degrees as OpenGL Performer has them: heading about z,
// counter-clockwise seen from above, 0 looking along +y; pitch about x, upward; roll about y; then the
// horizontal field of view in degrees and width over height. The appendix does not say which way the field of
// view goes: Performer's frusta take it horizontally.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "capture/photographs/camera_files.h"

namespace parvis::photographs {
namespace {

bool read_eight(std::string_view text, std::array<double, 8>& numbers) {
  for (double& number : numbers) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (code != std::errc() || !std::isfinite(number)) return false;
    text.remove_prefix(std::size_t(end - text.data()));
  }
  return text.find_first_not_of(" \t") == std::string_view::npos;
}

ViewOfPicture view_of(const std::array<double, 8>& n, std::string name) {
  glm::dmat4 m = glm::translate(glm::dmat4(1.0), {n[0], n[1], n[2]});
  m = glm::rotate(m, glm::radians(n[3]), {0.0, 0.0, 1.0});
  m = glm::rotate(m, glm::radians(n[4]), {1.0, 0.0, 0.0});
  m = glm::rotate(m, glm::radians(n[5]), {0.0, 1.0, 0.0});
  m = glm::rotate(m, glm::radians(90.0), {1.0, 0.0, 0.0});  // from looking along -z, y up to along +y, z up
  ViewOfPicture view;
  view.name = std::move(name);
  view.world_from_camera = m;
  view.fov = glm::radians(n[6]);
  view.across = ViewOfPicture::Across::width;
  return view;
}

}  // namespace

Result<std::vector<ViewOfPicture>> parse_thesis_cameras(std::string_view text, const std::string& name) {
  std::vector<ViewOfPicture> views;
  std::string file;
  int line = 1;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '\n') ++line;
    for (const std::string_view attribute : {"file=\"", "camera=\""}) {
      const bool is_whole = at == 0 || !std::isalnum(static_cast<unsigned char>(text[at - 1]));
      if (!is_whole || text.substr(at, attribute.size()) != attribute) continue;
      const std::size_t begin = at + attribute.size(), end = text.find('"', begin);
      if (end == std::string_view::npos) return error_at({name, line, 0}, "a text has no closing \"");
      const std::string_view value = text.substr(begin, end - begin);
      if (attribute.starts_with("file")) {
        file = value;
      } else {
        std::array<double, 8> numbers{};
        if (!read_eight(value, numbers) || !(numbers[6] > 0.0) || !(numbers[6] < 180.0) ||
            !(numbers[7] > 0.0))
          return error_at({name, line, 0},
                          "expected camera=\"x y z h p r fov aspect\": 8 numbers, fov between 0 and 180");
        views.push_back(view_of(numbers, file));
      }
      at = end;
      break;
    }
  }
  return views;
}

}  // namespace parvis::photographs
