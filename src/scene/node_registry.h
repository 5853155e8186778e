// The node types that scripts may use. Each room adds its own; those of the scene room are in core_nodes().
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "scene/node.h"
#include "scene/schema.h"

namespace parvis::scene {

class SceneBuilder;
struct Model;

/// Adds what the node stands for to the scene. Bad data goes to builder.fail() or builder.warn().
using BuildNode = std::function<void(const Node& node, SceneBuilder& builder)>;

/// Changes the model that the node's parent has read.
using ChangeModel = std::function<void(const Node& node, Model& model, SceneBuilder& builder)>;

/// Either builds something, or stands in a `model` and changes it; include does neither.
struct NodeType {
  NodeSchema schema;
  BuildNode build;
  ChangeModel change;
};

/// The checker puts the nodes of a file in the place of this node.
inline const std::string include_type = "include";

/// Nodes point into the registry that checked them: it must outlive them.
class NodeRegistry {
 public:
  /// Types are added once, with defaults that are values of their attribute's type.
  void add(NodeSchema schema, BuildNode build);
  void add_change(NodeSchema schema, ChangeModel change);

  const NodeType* find(const std::string& type) const;
  /// In the order added: those of a family stand together.
  const std::deque<NodeType>& types() const { return types_; }
  std::vector<std::string> type_names() const;
  /// The types of nodes that may stand in one of `parent`.
  std::vector<std::string> children_of(const std::string& parent) const;

 private:
  std::deque<NodeType> types_;
};

/// The node types of this room.
NodeRegistry core_nodes();

}  // namespace parvis::scene
