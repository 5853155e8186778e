#include "scene/script/spelling.h"

#include <fmt/format.h>

#include <cctype>

namespace parvis::scene {
std::string thesis_class(std::string_view type) {
  std::string name = "xp" + std::string(type);
  if (name.size() > 2) name[2] = char(std::toupper(static_cast<unsigned char>(name[2])));
  return name;
}

std::array<std::string, 2> unique_names(std::string_view type) {
  return {fmt::format("%{}", type), fmt::format("%{}", thesis_class(type))};
}

}  // namespace parvis::scene
