// The node types that scripts may use, and what is done when all nodes are built. Each room adds its own.
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "scene/script/node.h"
#include "scene/script/schema.h"

namespace parvis::scene {

class SceneBuilder;
struct Model;

/// Adds what the node stands for to the scene. Bad data goes to builder.fail() or builder.warn().
using BuildNode = std::function<void(const Node& node, SceneBuilder& builder)>;

/// Changes the model that the node's parent has read.
using ChangeModel = std::function<void(const Node& node, Model& model, SceneBuilder& builder)>;

/// What is left to do when all nodes of a scene are built: lanes out of roads, ... Bad data goes to
/// builder.fail().
using FinishStep = std::function<void(SceneBuilder& builder)>;

/// Builds something, or stands in a `model` and changes it, or is a part that the node around it reads.
struct NodeType {
  NodeSchema schema;
  BuildNode build;
  ChangeModel change;
  bool is_part = false;

  /// A change of such a node is a change of what the node around it makes.
  bool is_of_parent() const { return change != nullptr || is_part; }
};

/// The checker puts the nodes of a file in the place of this node.
inline const std::string include_type = "include";

/// Nodes point into the registry that checked them: it must outlive them.
class NodeRegistry {
 public:
  /// Types are added once, with defaults that are values of their attribute's type.
  void add(NodeSchema schema, BuildNode build);
  void add_change(NodeSchema schema, ChangeModel change);
  /// A node type that the build function of its parent reads.
  void add_part(NodeSchema schema);
  /// Lets nodes of the type `child`, which is added already, stand in those of another room's type.
  void allow(const std::string& child, const std::string& parent);
  /// Steps are done in the order added, once, when a scene is loaded.
  void add_finish_step(FinishStep step) { finish_steps_.push_back(std::move(step)); }
  const std::vector<FinishStep>& finish_steps() const { return finish_steps_; }

  const NodeType* find(const std::string& type) const;
  /// In the order added: those of a family stand together.
  const std::deque<NodeType>& types() const { return types_; }
  std::vector<std::string> type_names() const;
  /// The types of nodes that may stand in one of `parent`.
  std::vector<std::string> children_of(const std::string& parent) const;

 private:
  std::deque<NodeType> types_;
  std::vector<FinishStep> finish_steps_;
};

}  // namespace parvis::scene
