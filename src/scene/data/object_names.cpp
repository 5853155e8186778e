#include "scene/data/object_names.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace parvis::scene {

std::string object_names(const Scene& scene) {
  constexpr std::size_t max_names = 10;
  std::vector<std::string> names;
  bool are_more = false;
  for (const Object& object : scene.objects) {
    const std::string name = fmt::format("\"{}\"", object.name);
    if (object.name.empty() || std::ranges::find(names, name) != names.end()) continue;
    are_more = names.size() == max_names;
    if (are_more) break;
    names.push_back(name);
  }
  if (names.empty()) return "; there is none with a name";
  return fmt::format("; there {} {}{}", names.size() > 1 ? "are" : "is", fmt::join(names, ", "),
                     are_more ? " and others" : "");
}

}  // namespace parvis::scene
