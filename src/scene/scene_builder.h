// What the build functions of nodes work on: the scene so far, the frame they stand in, and what went wrong.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/node.h"
#include "scene/node_registry.h"
#include "scene/road_builder.h"
#include "scene/scene.h"

namespace parvis::scene {

/// A scene, and what its author should know about it: missing textures that a placeholder stands for, ...
struct LoadedScene {
  Scene scene;
  Errors warnings;
};

class SceneBuilder {
 public:
  explicit SceneBuilder(const NodeRegistry& registry) : registry_(registry) {}

  Scene scene;
  std::vector<Road> roads;  ///< in the world; finish() makes lanes of them
  bool has_paving = false;  ///< finish() lays carriageways on the ground

  /// Builds nodes that stand in a frame inside the present one.
  void build(const std::vector<Node>& nodes, const glm::mat4& parent_from_nodes = glm::mat4(1.0f));

  /// Lets a node that stands in a `model` change it.
  void change(Model& model, const Node& node) {
    registry_.find(node.schema->type)->change(node, model, *this);
  }

  /// The frame in which the node that is being built stands.
  const glm::mat4& world_from_parent() const { return world_from_parent_; }

  /// The model that `make` gave when `key` was first asked for: objects that look alike share one. Null if it
  /// fails.
  std::shared_ptr<const Model> shared_model(const std::string& key,
                                            const std::function<std::shared_ptr<const Model>()>& make);

  void fail(Error error) { errors_.push_back(std::move(error)); }
  /// Errors of a file that the node at `where` asked for.
  void fail(const Errors& errors, const FileLocation& where);
  void warn(Error warning) { warnings_.push_back(std::move(warning)); }

  /// The scene, when everything is built; or all that went wrong.
  Result<LoadedScene> finish() &&;

 private:
  const NodeRegistry& registry_;
  glm::mat4 world_from_parent_{1.0f};
  std::map<std::string, std::shared_ptr<const Model>> models_;
  Errors errors_, warnings_;
};

}  // namespace parvis::scene
