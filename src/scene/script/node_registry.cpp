#include "scene/script/node_registry.h"

#include <algorithm>
#include <cassert>
#include <string_view>

#include "scene/script/spelling.h"

namespace parvis::scene {

void NodeRegistry::add(NodeSchema schema, BuildNode build) {
  assert(!find(schema.type) && "a node type is added twice");
  schema.complete_messages();
  types_.push_back({std::move(schema), std::move(build), {}, false});
}

void NodeRegistry::add_change(NodeSchema schema, ChangeModel change) {
  assert(!find(schema.type) && "a node type is added twice");
  types_.push_back({std::move(schema), {}, std::move(change), false});
}

void NodeRegistry::add_part(NodeSchema schema) {
  assert(!find(schema.type) && "a node type is added twice");
  types_.push_back({std::move(schema), {}, {}, true});
}

void NodeRegistry::allow(const std::string& child, const std::string& parent) {
  const auto found = std::find_if(types_.begin(), types_.end(),
                                  [&](const NodeType& type) { return type.schema.type == child; });
  assert(found != types_.end() && "the node type that is to stand in another has not been added");
  found->schema.stands_in.push_back(parent);
}

const NodeType* NodeRegistry::find(const std::string& type) const {
  // In the thesis's scripts a leading % marks a node that the system makes itself.
  const std::string_view written = std::string_view(type).substr(type.starts_with('%') ? 1 : 0);
  const auto found = std::find_if(types_.begin(), types_.end(), [&](const NodeType& each) {
    return each.schema.type == written || thesis_class(each.schema.type) == written;
  });
  return found == types_.end() ? nullptr : &*found;
}

std::vector<std::string> NodeRegistry::type_names() const {
  std::vector<std::string> names;
  names.reserve(types_.size());
  for (const NodeType& type : types_) names.push_back(type.schema.type);
  return names;
}

std::vector<std::string> NodeRegistry::children_of(const std::string& parent) const {
  std::vector<std::string> names;
  for (const NodeType& type : types_) {
    const std::vector<std::string>& parents = type.schema.stands_in;
    if (std::find(parents.begin(), parents.end(), parent) != parents.end()) names.push_back(type.schema.type);
  }
  return names;
}

}  // namespace parvis::scene
