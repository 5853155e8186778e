// Registry of the node types that scripts may use, and of the steps after all nodes are built. Each room adds
// its own.
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "scene/script/node.h"
#include "scene/script/schema.h"

namespace parvis::scene {

class LiveScene;
class SceneBuilder;
struct Model;
struct Scene;

/// Builds what a node describes into the scene. Bad data is reported by builder.fail() or builder.warn().
using BuildNode = std::function<void(const Node& node, SceneBuilder& builder)>;

/// Changes the model that the node's parent has loaded.
using ChangeModel = std::function<void(const Node& node, Model& model, SceneBuilder& builder)>;

/// A step after all nodes of a scene are built, for example lanes from roads. Bad data is reported by
/// builder.fail().
using FinishStep = std::function<void(SceneBuilder& builder)>;

/// A step after nodes of a running scene have come, gone or changed place, for what was found out about all
/// of them when the scene was loaded.
using FollowStep = std::function<void(const LiveScene& live, Scene& scene)>;

/// A node type: it builds something, or changes the `model` that encloses it, or is a part that its parent
/// reads.
struct NodeType {
  NodeSchema schema;
  BuildNode build;
  ChangeModel change;
  bool is_part = false;

  /// True if a change of such a node requires its parent to be rebuilt.
  bool is_of_parent() const { return change != nullptr || is_part; }
};

/// The checker replaces a node of this type by the nodes of the file that it names.
inline const std::string include_type = "include";

/// The node types of the program. Nodes point into the registry that checked them: it must outlive them.
class NodeRegistry {
 public:
  /// Adds a type that builds something. Asserts that the type is new; defaults must be values of their
  /// attribute's type.
  void add(NodeSchema schema, BuildNode build);
  /// Adds a type that changes the model around it. Asserts that the type is new.
  void add_change(NodeSchema schema, ChangeModel change);
  /// Adds a type that the build function of its parent reads. Asserts that the type is new.
  void add_part(NodeSchema schema);
  /// Allows nodes of the type `child`, which must have been added, inside another room's type.
  void allow(const std::string& child, const std::string& parent);
  /// Adds a step; steps run in the order in which they were added, once per loaded scene.
  void add_finish_step(FinishStep step) { finish_steps_.push_back(std::move(step)); }
  /// The finish steps in the order in which they run.
  const std::vector<FinishStep>& finish_steps() const { return finish_steps_; }
  /// Adds a step that runs whenever a node of the loaded scene has been rebuilt: builder.scene holds only the
  /// objects and cameras that the node has just made.
  void add_rebuild_step(FinishStep step) { rebuild_steps_.push_back(std::move(step)); }
  /// The rebuild steps in the order in which they run.
  const std::vector<FinishStep>& rebuild_steps() const { return rebuild_steps_; }
  /// Adds a step that runs whenever a running scene has other nodes, or more objects, than before.
  void add_follow_step(FollowStep step) { follow_steps_.push_back(std::move(step)); }
  /// The follow steps in the order in which they run.
  const std::vector<FollowStep>& follow_steps() const { return follow_steps_; }

  const NodeType* find(const std::string& type) const;  ///< null if there is no such type
  /// All types in the order in which they were added: related types stand together.
  const std::deque<NodeType>& types() const { return types_; }
  std::vector<std::string> type_names() const;  ///< in the order in which they were added
  /// The types of nodes that may stand in one of `parent`.
  std::vector<std::string> children_of(const std::string& parent) const;

 private:
  std::deque<NodeType> types_;
  std::vector<FinishStep> finish_steps_, rebuild_steps_;
  std::vector<FollowStep> follow_steps_;
};

}  // namespace parvis::scene
