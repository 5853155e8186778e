// A running scene: messages and scenarios change node attributes; only the affected nodes are rebuilt, from
// models already loaded.
#pragma once

#include <deque>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "scene/script/message.h"
#include "scene/script/scene_builder.h"

namespace parvis::scene {

/// Stands for the scene without a scenario, unless one is called so.
inline const std::string base_scene = "base";

/// Keeps the nodes of one Scene, which its functions take. A moved one goes on as it was.
class LiveScene {
 public:
  LiveScene() = default;  ///< without nodes
  explicit LiveScene(Script script);
  /// Of a scene without a script; `unique_node` makes its nodes. The registry must outlive it.
  explicit LiveScene(const NodeRegistry& registry) { script_.registry = &registry; }

  const std::vector<Node>& nodes() const { return script_.nodes; }
  /// By its name, or as %TYPE; null where there is none.
  const Node* find(const std::string& name) const;
  /// The objects of the scene that the node and those inside it have made, hidden ones included.
  std::vector<int> objects_of(const Node& node) const;
  /// The node that made an object of the scene, or that has vehicles made of this name; null where there is
  /// none.
  const Node* maker_of(const Scene& scene, int object) const;
  /// The node that it stands in; null at the top level.
  const Node* parent_of(const Node& node) const;
  const NodeFrame& frame_of(const Node& node) const;
  /// False for a node that is part of another's: a material, the key of a path, a kind of vehicle. It stays
  /// as it was when the scene was loaded; but scenarios change the materials of models.
  bool is_built(const Node& node) const { return script_.frames.count(&node) != 0; }

  /// Gives an attribute of the node another value of its type, in place of those that it replaces; seen after
  /// the next `refresh`.
  void set(const Node& node, const std::string& attribute, AttributeValue value);
  /// The node of a unique type: the script's, or one without attributes that stands for it from now on.
  const Node& unique_node(const std::string& type);
  /// Gives the attribute the value that `text` writes, in every scenario: what the command line says. Errors
  /// say what is expected, and nothing has changed then.
  Status hold(const Node& node, const std::string& attribute, const std::string& text);
  /// Does what a message that every node type of its kind takes says: sets a live attribute, shows or hides.
  /// False where the message is none of these.
  bool receive(const Node& node, const Message& message);

  /// The scenarios in the order written.
  std::vector<const Node*> scenarios() const;
  /// The chosen one's name; empty: none, the base scene.
  const std::string& scenario() const { return scenario_; }
  /// Changes to another scenario (empty, or `base_scene`: to none): nodes of the old one get back their
  /// attributes as written. Fails where there is no such scenario, or where what it asks for cannot be built.
  Status choose(Scene& scene, const std::string& name);
  /// Builds what every scenario needs, hidden, so that choosing one loads nothing; then chooses the one that
  /// begins. All errors are reported. To be called before the scene is drawn: it adds objects.
  Status prepare_scenarios(Scene& scene);

  /// Builds again what changed. A node that cannot be built gets back the attributes that it had; errors tell
  /// which.
  Errors refresh(Scene& scene);

 private:
  Node& writable(const Node& node);
  Node& change(const Node& node);
  const Node* builder_of(const Node& node) const;
  void put_objects(Scene& scene, std::vector<Object> built, const std::vector<const Node*>& makers,
                   const Node& node);
  void put_cameras(Scene& scene, const std::vector<NamedCamera>& built,
                   const std::vector<const Node*>& makers);
  NodeRange range_of(const Node& node) const;
  Errors build_again(Scene& scene, const Node& node);
  void change_by(const Node& scenario);

  Script script_;
  std::map<std::string, Node*> by_name_;
  std::map<const Node*, const Node*> parents_;                 ///< of nodes that stand in others
  std::map<const Node*, std::vector<int>> objects_, cameras_;  ///< made by each node
  std::map<const Node*, std::vector<NodeAttribute>> changed_;  ///< and what they were at the last refresh
  std::map<Node*, std::vector<NodeAttribute>> as_written_;  ///< attributes of nodes that the scenario changed
  std::string scenario_;
  std::deque<Node> added_;  ///< beside the script's
  std::map<const Node*, std::map<std::string, AttributeValue>> held_;
};

}  // namespace parvis::scene
