#include "scene/scene_builder.h"

namespace parvis::scene {

void SceneBuilder::build(const std::vector<Node>& nodes, const glm::mat4& parent_from_nodes) {
  const glm::mat4 outer = world_from_parent_;
  world_from_parent_ = outer * parent_from_nodes;
  for (const Node& node : nodes) registry_.find(node.schema->type)->build(node, *this);
  world_from_parent_ = outer;
}

void SceneBuilder::fail(const Errors& errors, const FileLocation& where) {
  for (const Error& error : errors)
    errors_.push_back(error.where.file.empty() ? Error{error.message, where}
                                               : error_at(where, "{}", to_string(error)));
}

Result<LoadedScene> SceneBuilder::finish() && {
  if (!errors_.empty()) return std::move(errors_);
  return LoadedScene{std::move(scene), std::move(warnings_)};
}

}  // namespace parvis::scene
