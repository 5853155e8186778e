// A running scene: messages and scenarios change node attributes, and nodes are inserted, removed, renamed
// and moved; only the affected nodes are rebuilt, from models already loaded.
#pragma once

#include <deque>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scene/script/message.h"
#include "scene/script/scene_builder.h"

namespace parvis::scene {

/// The name that selects the scene without a scenario, unless a scenario has this name.
inline const std::string base_scene = "base";

/// Where a node stands among the others.
struct NodePosition {
  const Node* parent = nullptr;  ///< null: at the top level
  const Node* before = nullptr;  ///< one that stands in `parent`; null: behind all of them
};

/// The nodes of one running Scene, which its functions take as an argument. Moving it keeps all nodes at
/// their addresses.
class LiveScene {
 public:
  LiveScene() = default;  ///< without nodes
  explicit LiveScene(Script script);
  /// Creates a scene without a script; `unique_node` creates its nodes. The registry must outlive it.
  explicit LiveScene(const NodeRegistry& registry) { script_.registry = &registry; }

  const NodeRegistry& registry() const { return *script_.registry; }  ///< of the nodes' types
  /// The top-level nodes of the script; included files' nodes are in place.
  const Nodes& nodes() const { return script_.nodes; }
  /// The node of this name, or of a unique type written %TYPE; null if there is none.
  const Node* find(const std::string& name) const;
  /// Indices of the scene's objects made by the node and those inside it, hidden ones included.
  std::vector<int> objects_of(const Node& node) const;
  /// The node that made an object of the scene, or whose vehicles have this name; null if there is none.
  const Node* maker_of(const Scene& scene, int object) const;
  /// The node that encloses it; null at the top level.
  const Node* parent_of(const Node& node) const;
  /// The frame in which the node was built; the world's for a node that is part of another.
  const NodeFrame& frame_of(const Node& node) const;
  /// False for a node that has been removed.
  bool holds(const Node& node) const { return is_built(node) || parent_of(node); }
  /// The node that stands behind it in its parent, or at the top level; null: it is the last.
  const Node* next_of(const Node& node) const;
  /// Numbers of the node and of those inside it that were built.
  NodeRange range_of(const Node& node) const;
  /// False for a node that is part of another: a material, a key of a path, a kind of vehicle. Such a node
  /// does not change after loading, except that scenarios change the materials of models.
  bool is_built(const Node& node) const { return script_.frames.count(&node) != 0; }

  /// Gives an attribute of the node a new value of its type and clears the attributes that it replaces. Takes
  /// effect with the next `refresh`.
  void set(const Node& node, const std::string& attribute, AttributeValue value);
  /// The same for all attributes of the node at once.
  void set_all(const Node& node, std::vector<NodeAttribute> attributes);
  /// The node of a unique type: the script's, or a new one without attributes.
  const Node& unique_node(const std::string& type);
  /// Gives the attribute the value that `text` spells, for every scenario (command line). On an error, which
  /// says what is expected, nothing changes.
  Status hold(const Node& node, const std::string& attribute, const std::string& text);
  /// Applies the messages that are common to all node types: set a live attribute, show or hide. Returns
  /// false for any other message.
  bool receive(const Node& node, const Message& message);

  /// The scenarios in the order of the script.
  std::vector<const Node*> scenarios() const;
  /// Name of the active scenario; empty: none, the base scene.
  const std::string& scenario() const { return scenario_; }
  /// Activates another scenario (empty or `base_scene`: none): attributes that the previous one changed are
  /// restored. Fails if there is no such scenario, or if its nodes cannot be built.
  Status choose(Scene& scene, const std::string& name);
  /// Builds, hidden, everything that any scenario needs, so that switching loads nothing; then activates the
  /// initial scenario. Reports all errors. Call it before the scene is rendered: it adds objects.
  Status prepare_scenarios(Scene& scene);

  // Each of the following takes effect at once in `scene`, or, where it fails, changes nothing. An object
  // keeps its index as long as the scene runs: new ones come last, and what is removed stays hidden in its
  // place until a node beside it makes an object of the same model. What stands in roads or maps when the
  // scene is loaded is laid out once: such nodes neither come nor go.

  /// Inserts a node with all that stands in it, and builds it. Its names are new in the scene.
  Result<const Node*> insert(Scene& scene, Node node, const NodePosition& at);
  /// The same for the nodes of a piece of script, which may refer to the scene's. `file` stands in errors;
  /// files that the piece names are relative to it.
  Result<std::vector<const Node*>> insert_script(Scene& scene, std::string_view script,
                                                 const NodePosition& at, const Roots& roots,
                                                 const std::string& file);
  /// Takes a node out of the scene with all that stands in it. It keeps its address: `put_back` inserts it
  /// again. Fails where another node refers to it.
  Status remove(Scene& scene, const Node& node);
  /// Inserts a removed node again.
  Status put_back(Scene& scene, const Node& removed, const NodePosition& at);
  /// Gives a node another name, and the new name to all that refer to it.
  Status rename(Scene& scene, const Node& node, const std::string& name);
  /// Puts a node, with all that stands in it, elsewhere.
  Status move(Scene& scene, const Node& node, const NodePosition& to);
  /// How often nodes have come, gone, or changed place or name.
  int edits() const { return edits_; }

  /// Rebuilds the nodes that changed. Where a node cannot be built, each attribute that was set since the
  /// last refresh and with which it cannot be gets its previous value back; the errors name the node.
  Errors refresh(Scene& scene);

 private:
  struct Setting {
    const Node* node;
    std::string attribute;
    AttributeValue value;
  };

  Node& writable(const Node& node);
  Node& change(const Node& node);
  const Node* builder_of(const Node& node) const;
  void put_objects(Scene& scene, std::vector<Object> built, const std::vector<const Node*>& makers,
                   const Node& node);
  void put_cameras(Scene& scene, const std::vector<NamedCamera>& built,
                   const std::vector<const Node*>& makers);
  Errors build_again(Scene& scene, const Node& node);
  Errors apply_singly(Scene& scene, const Node& builder, const std::vector<Setting>& settings);
  void change_by(const Node& scenario);
  void follow_objects(Scene& scene, std::size_t objects_before);

  Nodes& nodes_beside(const Node* parent);
  Status check_names(const Nodes& nodes) const;
  Status check_place(const Nodes& nodes, const Node* parent) const;
  Status check_unused(const Node& node) const;
  void know(Node& node, const Node* parent);
  void forget(const Node& node);
  Status insert(Scene& scene, Nodes& nodes, const NodePosition& at);
  void take_out(Scene& scene, const Node& node, Nodes& into);
  Errors build_new(Scene& scene, const Node* parent, const std::set<const Node*>& made);
  void renumber(Scene& scene);
  void follow_edit(Scene& scene);

  Script script_;
  std::map<std::string, Node*> by_name_;
  std::map<const Node*, const Node*> parents_;                 ///< of nodes that stand in others
  std::map<const Node*, std::vector<int>> objects_, cameras_;  ///< made by each node
  std::map<const Node*, std::vector<NodeAttribute>> changed_;  ///< and what they were at the last refresh
  std::vector<Setting> settings_;  ///< since the last refresh: the last of each attribute, in their order
  std::map<Node*, std::vector<NodeAttribute>> as_written_;  ///< attributes of nodes that the scenario changed
  std::string scenario_;
  std::deque<Node> added_;  ///< beside the script's
  Nodes removed_;
  std::map<const Node*, std::set<int>> spare_;  ///< hidden objects of removed nodes, by what these stood in
  int edits_ = 0;
  std::map<const Node*, std::map<std::string, AttributeValue>> held_;
};

}  // namespace parvis::scene
