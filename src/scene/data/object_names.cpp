#include "scene/data/object_names.h"

#include <set>

namespace parvis::scene {

std::vector<std::string> object_names(const Scene& scene) {
  std::vector<std::string> names;
  std::set<std::string_view> seen;
  for (const Object& object : scene.objects)
    if (!object.name.empty() && seen.insert(object.name).second) names.push_back(object.name);
  return names;
}

}  // namespace parvis::scene
