#include "scene/scene_builder.h"

#include "scene/paving.h"

namespace parvis::scene {

void SceneBuilder::build(const std::vector<Node>& nodes, const glm::mat4& parent_from_nodes) {
  const glm::mat4 outer = world_from_parent_;
  world_from_parent_ = outer * parent_from_nodes;
  for (const Node& node : nodes) registry_.find(node.schema->type)->build(node, *this);
  world_from_parent_ = outer;
}

std::shared_ptr<const Model> SceneBuilder::shared_model(
    const std::string& key, const std::function<std::shared_ptr<const Model>()>& make) {
  const auto known = models_.find(key);
  if (known != models_.end()) return known->second;
  return models_[key] = make();
}

void SceneBuilder::fail(const Errors& errors, const FileLocation& where) {
  for (const Error& error : errors)
    errors_.push_back(error.where.file.empty() ? Error{error.message, where}
                                               : error_at(where, "{}", to_string(error)));
}

Result<LoadedScene> SceneBuilder::finish() && {
  Result<RoadGraph> graph = build_road_graph(roads);
  if (graph)
    scene.roads = std::move(*graph);
  else
    errors_.insert(errors_.end(), graph.errors().begin(), graph.errors().end());
  if (!errors_.empty()) return std::move(errors_);
  if (has_paving) pave(scene);
  return LoadedScene{std::move(scene), std::move(warnings_)};
}

}  // namespace parvis::scene
