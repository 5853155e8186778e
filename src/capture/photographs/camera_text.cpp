// Cameras of benchmark data: Strecha's .camera files, and JSON with K, R and C or t.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/json_guard.h"
#include "capture/photographs/camera_files.h"

namespace parvis::photographs {
namespace {
using Json = nlohmann::json;

/// Both formats count pixels from the centre of the first: half a pixel less than here.
constexpr double first_pixel_centre = 0.5;

/// A rotation of opencv_from_world (row by row in files) and the camera's place, as a pose. False for no
/// rotation.
bool set_pose(Photograph& photograph, const glm::dmat3& opencv_from_world, glm::dvec3 centre) {
  constexpr double tolerance = 1e-3;
  const glm::dmat3 identity = opencv_from_world * glm::transpose(opencv_from_world);
  for (int i = 0; i < 3; ++i)
    if (!(glm::length(identity[i] - glm::dmat3(1.0)[i]) < tolerance) || !std::isfinite(centre[i]))
      return false;
  if (!(glm::determinant(opencv_from_world) > 0.0)) return false;
  glm::dmat4 pose(opencv_from_world);
  pose[3] = glm::dvec4(-(opencv_from_world * centre), 1.0);
  photograph.world_from_camera = world_from_camera_of_opencv(pose);
  return true;
}

/// All numbers of a JSON value, of nested arrays one after the other. False where something else stands
/// there.
bool read_numbers(const Json& value, std::vector<double>& numbers, int depth = 0) {
  if (value.is_number()) {
    numbers.push_back(value.get<double>());
    return std::isfinite(numbers.back());
  }
  if (!value.is_array() || depth > 2 || value.size() > 16) return false;
  for (const Json& part : value)
    if (!read_numbers(part, numbers, depth + 1)) return false;
  return true;
}

/// A member's numbers where there are exactly `count`, else none.
std::vector<double> numbers_of(const Json& entry, const char* member, std::size_t count) {
  std::vector<double> numbers;
  if (!entry.contains(member) || !read_numbers(entry[member], numbers) || numbers.size() != count) return {};
  return numbers;
}

glm::dmat3 from_rows(const std::vector<double>& n) {
  return glm::transpose(glm::dmat3(n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8]));
}

Result<Photograph> photograph_of_entry(const Json& entry) {
  if (!entry.is_object()) return error("expected an object per photograph");
  Photograph photograph;
  for (const char* member : {"image", "name"})
    if (photograph.name.empty() && entry.contains(member) && entry[member].is_string())
      photograph.name = entry[member].get<std::string>();
  const std::vector<double> width = numbers_of(entry, "width", 1), height = numbers_of(entry, "height", 1);
  std::vector<double> k = numbers_of(entry, "K", 9);
  if (k.empty()) {
    for (const char* member : {"fx", "fy", "cx", "cy"})
      for (const double number : numbers_of(entry, member, 1)) k.push_back(number);
    if (k.size() == 4) k = {k[0], 0.0, k[2], 0.0, k[1], k[3], 0.0, 0.0, 1.0};
  }
  const std::vector<double> r = numbers_of(entry, "R", 9), c = numbers_of(entry, "C", 3),
                            t = numbers_of(entry, "t", 3);
  constexpr double max_side = 1 << 20;
  if (photograph.name.empty() || width.empty() || height.empty() || k.size() != 9 || r.empty() ||
      (c.empty() && t.empty()))
    return error("{}: expected name, width, height, K (or fx, fy, cx, cy), R, and C or t", photograph.name);
  if (!(width[0] >= 1.0) || !(height[0] >= 1.0) || width[0] > max_side || height[0] > max_side ||
      !(k[0] > 0.0) || !(k[4] > 0.0))
    return error("{}: expected a size and a focal length > 0", photograph.name);
  photograph.lens = pinhole_lens(int(width[0]), int(height[0]), k[0], k[4], k[2] + first_pixel_centre,
                                 k[5] + first_pixel_centre);
  const glm::dmat3 opencv_from_world = from_rows(r);
  const glm::dvec3 centre = c.empty() ? -(glm::transpose(opencv_from_world) * glm::dvec3(t[0], t[1], t[2]))
                                      : glm::dvec3(c[0], c[1], c[2]);
  if (!set_pose(photograph, opencv_from_world, centre)) return error("{}: R is no rotation", photograph.name);
  return photograph;
}

}  // namespace

Result<PhotographSet> parse_camera_json(std::string_view text, const std::string& name) {
  if (Status depth = check_json_depth(text, name); !depth) return depth.errors();
  const Json json = Json::parse(text, nullptr, false);
  const Json& list = json.is_object() && json.contains("images") ? json["images"] : json;
  if (!list.is_array())
    return error("{}: expected a list of photographs, or an object with \"images\"", name);
  PhotographSet set;
  Errors problems;
  for (const Json& entry : list) {
    Result<Photograph> photograph = photograph_of_entry(entry);
    if (photograph)
      set.photographs.push_back(std::move(*photograph));
    else
      problems.push_back(error_at({name, 0, 0}, "{}", photograph.errors().front().message));
    if (problems.size() > 20) break;
  }
  if (!problems.empty()) return problems;
  return set;
}

Result<Photograph> parse_strecha_camera(std::string_view text, const std::string& name) {
  std::vector<double> n;
  while (n.size() <= 26) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    if (text.empty()) break;
    double number = 0.0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (code != std::errc() || !std::isfinite(number)) break;
    n.push_back(number);
    text.remove_prefix(std::size_t(end - text.data()));
  }
  constexpr double max_side = 1 << 20;
  if (n.size() != 26 || !text.empty() || !(n[24] >= 1.0) || !(n[25] >= 1.0) || n[24] > max_side ||
      n[25] > max_side || !(n[0] > 0.0) || !(n[4] > 0.0))
    return error("{}: expected 26 numbers: K, 0 0 0, R, C, width and height", name);
  Photograph photograph;
  photograph.lens =
      pinhole_lens(int(n[24]), int(n[25]), n[0], n[4], n[2] + first_pixel_centre, n[5] + first_pixel_centre);
  const glm::dmat3 world_from_opencv = from_rows({n.begin() + 12, n.begin() + 21});
  if (!set_pose(photograph, glm::transpose(world_from_opencv), {n[21], n[22], n[23]}))
    return error("{}: R is no rotation", name);
  return photograph;
}

}  // namespace parvis::photographs
