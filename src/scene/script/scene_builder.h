// The state of a scene under construction, as the build functions of nodes see it: the scene so far, the
// current frame, and the errors.
#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/result.h"
#include "scene/data/scene.h"
#include "scene/script/node.h"
#include "scene/script/node_registry.h"

namespace parvis::scene {

/// Frame and visibility that a group gives to its nodes.
struct NodeFrame {
  glm::mat4 world_from_nodes{1.0f};
  bool is_visible = true;
  int number = -1;  ///< of a built node: in the order of the script, parents before children
};

/// Models by a key that describes how they were made: equal objects share one.
using SharedModels = std::map<std::string, std::shared_ptr<const Model>>;

/// The nodes of a scene and what each of them made, kept for a running scene. Moving it keeps nodes at their
/// addresses.
struct Script {
  const NodeRegistry* registry = nullptr;  ///< must outlive it
  Nodes nodes;
  std::unordered_map<const Node*, NodeFrame> frames;  ///< in which each node stands
  std::vector<const Node*> object_makers,
      camera_makers;  ///< the node that made each object and camera, or null
  SharedModels models;
};

/// A loaded scene with its warnings, for example textures replaced by a placeholder.
struct LoadedScene {
  Scene scene;
  Errors warnings;
  Script script;
};

/// Builds a scene from checked nodes.
class SceneBuilder {
 public:
  explicit SceneBuilder(const NodeRegistry& registry, SharedModels models = {})
      : registry_(registry), models_(std::move(models)) {}

  /// The scene so far. Values that exist once (light, data of rooms) are written here directly; anything that
  /// nodes make in numbers goes through `add`.
  Scene scene;

  /// Adds an object and records it with the node that is being built: when that node is rebuilt, only its own
  /// objects, cameras and items are replaced.
  void add(Object object);
  /// Adds a camera, recorded in the same way.
  void add(NamedCamera camera);
  /// Adds an item of room data (Scene::items), recorded in the same way.
  template <SceneItem T>
  void add(T item) {
    scene.data<ItemsOf<T>>().add(std::move(item), node_number_);
  }
  /// Adds items in their order, as `add` does one; the time is that of all items of the type.
  template <SceneItem T>
  void add_all(std::vector<T> items) {
    add_made_by(node_number_, std::move(items));
  }
  /// Adds items as `add_all` does, but items that belong to the object at this index of the scene: recorded
  /// with the node that made the object, they are replaced with it. For finish and rebuild steps.
  template <SceneItem T>
  void add_all_for(std::size_t object, std::vector<T> items) {
    add_made_by(maker_number(object), std::move(items));
  }

  /// Adds objects that a finish step makes for the node of this number, which is laid out once: they are
  /// shown and hidden with it.
  void add_for(int maker, std::vector<Object> objects);

  /// Builds nodes inside the current frame; hidden ones are built, too.
  void build(const Nodes& nodes, const glm::mat4& parent_from_nodes = glm::mat4(1.0f),
             bool is_visible = true);
  /// Rebuilds one node in its former frame and runs the rebuild steps; types that are laid out once are
  /// skipped. `frames` holds the frame of each node, for those inside it. The scene must hold no other
  /// objects and cameras.
  void build_again(const Node& node, const std::unordered_map<const Node*, NodeFrame>& frames);
  /// Builds, of the nodes of a running scene, those that stand in `parent` (null: at the top level, among
  /// `top`) and are among `wanted`, and runs the rebuild steps. `frames` holds their numbers and the frame of
  /// the parent, which makes its own things once more.
  void build_inside(const Node* parent, const Nodes& top, const std::set<const Node*>& wanted,
                    const std::unordered_map<const Node*, NodeFrame>& frames);

  /// Applies a node that stands inside a `model` to that model.
  void change(Model& model, const Node& node) {
    registry_.find(node.schema->type)->change(node, model, *this);
  }

  /// The node of this name; null if none that has been built has it. For finish steps: a node that is rebuilt
  /// does not know the others.
  const Node* find(const std::string& name) const;
  /// The numbers of a node that has been built and of those inside it.
  NodeRange range_of(const Node& node) const;
  /// Indices of the objects that the node of this name, or those inside it, have made so far. For finish
  /// steps.
  std::vector<int> objects_of(const std::string& name) const;

  /// Frame of the node that is being built: world from the node's parent.
  const glm::mat4& world_from_parent() const { return frame_.world_from_nodes; }
  /// True if no enclosing group is hidden.
  bool is_visible() const { return frame_.is_visible; }

  /// The model made by `make` when `key` was first requested, so that equal objects share one. Null if `make`
  /// fails.
  std::shared_ptr<const Model> shared_model(const std::string& key,
                                            const std::function<std::shared_ptr<const Model>()>& make);

  /// Records an error: the scene will not load.
  void fail(Error error) { errors_.push_back(std::move(error)); }
  /// Records several errors.
  void fail(const Errors& errors) { errors_.insert(errors_.end(), errors.begin(), errors.end()); }
  /// Records errors of a file that the node at `where` refers to.
  void fail(const Errors& errors, const FileLocation& where);
  /// Records a warning; the scene still loads.
  void warn(Error warning) { warnings_.push_back(std::move(warning)); }

  /// Runs the finish steps and returns the scene, or all errors.
  Result<LoadedScene> finish() &&;

  const Errors& errors() const { return errors_; }  ///< recorded so far
  /// The record of frames and makers, without the nodes.
  Script take_script() &&;

 private:
  /// Which objects the nodes have made, and which nodes have a name: asked for once, not per name.
  struct Makers {
    std::size_t nodes = 0, objects = 0;  ///< of which this is known
    std::unordered_map<std::string, const Node*> of_name;
    std::unordered_map<const Node*, std::vector<int>> made_by;
  };

  void build_one(const Node& node);
  const Makers& makers() const;
  int maker_number(std::size_t object) const;
  template <SceneItem T>
  void add_made_by(int maker, std::vector<T> items) {
    ItemsOf<T>& all = scene.data<ItemsOf<T>>();
    ItemsOf<T> later = all.take({maker + 1, std::numeric_limits<int>::max()});
    for (T& item : items) all.add(std::move(item), maker);
    for (std::size_t i = 0; i < later.items.size(); ++i) all.add(std::move(later.items[i]), later.makers[i]);
  }

  const NodeRegistry& registry_;
  NodeFrame frame_;
  const Node* node_ = nullptr;  ///< that is being built
  int node_number_ = -1, next_number_ = 0;
  std::unordered_map<const Node*, NodeFrame> frames_;
  std::vector<const Node*> object_makers_, camera_makers_;
  SharedModels models_;
  mutable Makers named_;
  const std::unordered_map<const Node*, NodeFrame>* known_frames_ = nullptr;  ///< of a scene that is rebuilt
  const std::set<const Node*>* wanted_ = nullptr;  ///< of the nodes beside each other; null: all
  Errors errors_, warnings_;
};

}  // namespace parvis::scene
