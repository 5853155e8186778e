// What the build functions of nodes work on: the scene so far, the frame they stand in, and what went wrong.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/result.h"
#include "scene/data/scene.h"
#include "scene/script/node.h"
#include "scene/script/node_registry.h"

namespace parvis::scene {

/// Where the nodes of a group stand, and whether they are to be seen.
struct NodeFrame {
  glm::mat4 world_from_nodes{1.0f};
  bool is_visible = true;
  int number = -1;  ///< of a node that was built: in the order of the script, a node before those inside it
};

/// Models by what they were made of: objects that look alike share one.
using SharedModels = std::map<std::string, std::shared_ptr<const Model>>;

/// What a scene that runs keeps of its script. Nodes stay where they are in memory when it is moved.
struct Script {
  const NodeRegistry* registry = nullptr;  ///< must outlive it
  std::vector<Node> nodes;
  std::unordered_map<const Node*, NodeFrame> frames;  ///< in which each node stands
  std::vector<const Node*> object_makers,
      camera_makers;  ///< the node that made each object and camera, or null
  SharedModels models;
};

/// A scene, and what its author should know about it: missing textures that a placeholder stands for, ...
struct LoadedScene {
  Scene scene;
  Errors warnings;
  Script script;
};

class SceneBuilder {
 public:
  explicit SceneBuilder(const NodeRegistry& registry, SharedModels models = {})
      : registry_(registry), models_(std::move(models)) {}

  /// What stands in it once (light, rooms' data) is written here; what nodes make any number of is added
  /// below.
  Scene scene;

  /// Adds what the node that is being built makes. It is recorded with the node: when the node is built
  /// again, this and nothing else is replaced.
  void add(Object object);
  void add(NamedCamera camera);
  template <SceneItem T>
  void add(T item) {
    scene.data<ItemsOf<T>>().add(std::move(item), node_number_);
  }

  /// Builds nodes that stand in a frame inside the present one; hidden ones are built, too.
  void build(const std::vector<Node>& nodes, const glm::mat4& parent_from_nodes = glm::mat4(1.0f),
             bool is_visible = true);
  /// Builds one node again, in the frame in which it stood. What is laid out once is left out. `frames`: in
  /// which each node stood, for those inside it.
  void build_again(const Node& node, const std::unordered_map<const Node*, NodeFrame>& frames);

  /// Lets a node that stands in a `model` change it.
  void change(Model& model, const Node& node) {
    registry_.find(node.schema->type)->change(node, model, *this);
  }

  /// The frame in which the node that is being built stands.
  const glm::mat4& world_from_parent() const { return frame_.world_from_nodes; }
  /// None of the groups around that node is hidden.
  bool is_visible() const { return frame_.is_visible; }

  /// The model that `make` gave when `key` was first asked for: objects that look alike share one. Null if it
  /// fails.
  std::shared_ptr<const Model> shared_model(const std::string& key,
                                            const std::function<std::shared_ptr<const Model>()>& make);

  void fail(Error error) { errors_.push_back(std::move(error)); }
  void fail(const Errors& errors) { errors_.insert(errors_.end(), errors.begin(), errors.end()); }
  /// Errors of a file that the node at `where` asked for.
  void fail(const Errors& errors, const FileLocation& where);
  void warn(Error warning) { warnings_.push_back(std::move(warning)); }

  /// The scene, when everything is built and the registry's finish steps are done; or all that went wrong.
  Result<LoadedScene> finish() &&;

  const Errors& errors() const { return errors_; }
  /// What it noted while it built: all but the nodes.
  Script take_script() &&;

 private:
  void build_one(const Node& node);

  const NodeRegistry& registry_;
  NodeFrame frame_;
  const Node* node_ = nullptr;  ///< that is being built
  int node_number_ = -1, next_number_ = 0;
  std::unordered_map<const Node*, NodeFrame> frames_;
  std::vector<const Node*> object_makers_, camera_makers_;
  SharedModels models_;
  const std::unordered_map<const Node*, NodeFrame>* known_frames_ = nullptr;  ///< of a scene that is rebuilt
  Errors errors_, warnings_;
};

}  // namespace parvis::scene
