#include "scene/data/triangle_kinds.h"

#include <algorithm>
#include <set>

namespace parvis::scene {

std::string kind_name(const std::string& object_name) {
  const std::size_t last = object_name.find_last_not_of("0123456789 ");
  return last == std::string::npos ? object_name : object_name.substr(0, last + 1);
}

std::vector<TriangleKind> triangle_kinds(const Scene& scene) {
  std::vector<TriangleKind> kinds;
  std::set<const Model*> stored;
  for (const Object& object : scene.objects) {
    const std::string name = kind_name(object.name);
    auto kind = std::ranges::find(kinds, name, &TriangleKind::name);
    if (kind == kinds.end()) kind = kinds.insert(kind, TriangleKind{.name = name});
    const std::size_t triangles = object.model->triangle_count();
    ++kind->objects, kind->placed += triangles;
    if (stored.insert(object.model.get()).second) kind->stored += triangles;
  }
  std::ranges::stable_sort(kinds, std::ranges::greater(), &TriangleKind::stored);
  return kinds;
}

}  // namespace parvis::scene
