#include "scene/data/model_parts.h"

#include <set>

#include "scene/data/name_pattern.h"

namespace parvis::scene {

namespace {

/// The name of a node, or of the one that it stands in: readers add nodes of their own below those of a file.
const std::string& name_of_node(const Model& model, int node) {
  while (model.nodes[std::size_t(node)].name.empty() && model.nodes[std::size_t(node)].parent != no_index)
    node = model.nodes[std::size_t(node)].parent;
  return model.nodes[std::size_t(node)].name;
}

}  // namespace

std::vector<std::size_t> matching_parts(const Model& model, std::string_view target) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < model.parts.size(); ++i) {
    const Part& part = model.parts[i];
    if (matches(target, part.object) || matches(target, name_of_node(model, part.node)) ||
        matches(target, model.materials[std::size_t(part.material)].name))
      found.push_back(i);
  }
  return found;
}

std::vector<std::string> part_names(const Model& model) {
  std::set<std::string> names;
  for (const Part& part : model.parts)
    for (const std::string& name : {part.object, model.materials[std::size_t(part.material)].name})
      if (!name.empty()) names.insert(name);
  return {names.begin(), names.end()};
}

}  // namespace parvis::scene
