// What the triangles of a scene show: a count for each kind of object.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/data/scene.h"

namespace parvis::scene {

/// Objects of one kind: of the same name but for the number at its end.
struct TriangleKind {
  std::string name;         ///< "parked car" of "parked car 12"
  std::size_t objects = 0;  ///< how many there are
  std::size_t stored = 0;   ///< triangles of their models, each model once
  std::size_t placed = 0;   ///< triangles of their models, once per object
};

/// The kinds of all objects of the scene, those with the most stored triangles first. A model that several
/// kinds share is stored with the first of them.
std::vector<TriangleKind> triangle_kinds(const Scene& scene);

/// The objects' names without numbers at their ends: "lane 3" and "lane" give "lane".
std::string kind_name(const std::string& object_name);

}  // namespace parvis::scene
