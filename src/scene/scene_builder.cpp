#include "scene/scene_builder.h"

#include "scene/paving.h"

namespace parvis::scene {

void SceneBuilder::build_one(const Node& node) {
  if (builds_again_ && node.schema->is_laid_out_once && !node.schema->find("visible")) return;
  frames_[&node] = frame_;
  registry_.find(node.schema->type)->build(node, *this);
  // Nodes inside have noted theirs already.
  object_makers_.resize(scene.objects.size(), &node);
  camera_makers_.resize(scene.cameras.size(), &node);
}

void SceneBuilder::build(const std::vector<Node>& nodes, const glm::mat4& parent_from_nodes,
                         bool is_visible) {
  const NodeFrame outer = frame_;
  frame_.world_from_nodes = outer.world_from_nodes * parent_from_nodes;
  frame_.is_visible = outer.is_visible && is_visible;
  for (const Node& node : nodes) build_one(node);
  frame_ = outer;
}

void SceneBuilder::build_again(const Node& node, const NodeFrame& frame) {
  builds_again_ = true;
  frame_ = frame;
  build_one(node);
}

Script SceneBuilder::take_script() && {
  object_makers_.resize(scene.objects.size(), nullptr);
  return {&registry_,        {}, std::move(frames_), std::move(object_makers_), std::move(camera_makers_),
          std::move(models_)};
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
  Script script = std::move(*this).take_script();
  return LoadedScene{std::move(scene), std::move(warnings_), std::move(script)};
}

}  // namespace parvis::scene
