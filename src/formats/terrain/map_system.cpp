#include "formats/terrain/map_system.h"

#include <algorithm>
#include <cctype>

#include "formats/terrain/proj_module.h"

namespace parvis::scene {
namespace {

constexpr std::size_t max_digits = 6;  // of EPSG's numbers

}  // namespace

Status projections_known() {
  const Result<const ProjFunctions*> functions = proj.functions();
  return functions ? Status(Ok{}) : functions.errors();
}

std::optional<int> epsg_in(std::string_view name) {
  std::string lower(name);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  const std::size_t authority = lower.find("epsg");
  if (authority == std::string::npos) return std::nullopt;
  const std::size_t begin = authority + 4;
  const std::string number = lower.substr(begin, lower.find_first_of(",&+ \t\r\n", begin) - begin);
  const std::size_t last = number.find_last_of("0123456789");
  if (last == std::string::npos || last + 1 != number.size()) return std::nullopt;
  const std::size_t before = number.find_last_not_of("0123456789");
  const std::string digits = number.substr(before == std::string::npos ? 0 : before + 1);
  return digits.size() <= max_digits ? std::optional(std::stoi(digits)) : std::nullopt;
}

std::optional<MapSystem> map_system(int epsg) {
  const Result<const ProjFunctions*> functions = proj.functions();
  return functions ? (*functions)->map_system(epsg) : std::nullopt;
}

bool lies_in_area(int epsg, glm::dvec2 on_map) {
  const Result<const ProjFunctions*> functions = proj.functions();
  return functions && (*functions)->lies_in_area(epsg, on_map);
}

std::optional<glm::dvec2> place_on_earth(int epsg, glm::dvec2 on_map) {
  const Result<const ProjFunctions*> functions = proj.functions();
  return functions ? (*functions)->place_on_earth(epsg, on_map) : std::nullopt;
}

}  // namespace parvis::scene
