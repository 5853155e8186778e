// Nodes that come, go, or change their place and name while the scene runs.
#include <algorithm>
#include <cassert>
#include <utility>

#include "scene/data/leaf_openness.h"
#include "scene/script/live_scene.h"
#include "scene/script/script_checker.h"
#include "scene/script/spelling.h"

namespace parvis::scene {
namespace {

template <class NodeType, class Visit>
void visit_tree(NodeType& node, const Visit& visit) {
  visit(node);
  for (auto& child : node.children) visit_tree(child, visit);
}

/// The names by which `LiveScene::find` knows a node: its own name, those of its type if that is unique.
std::vector<std::string> names_of(const Node& node) {
  std::vector<std::string> names;
  if (node.schema->is_unique)
    for (const std::string& name : unique_names(node.schema->type)) names.push_back(name);
  if (node.schema->find("name") && node.gives("name")) names.push_back(node.text("name"));
  return names;
}

/// The words of a message that may be names: all but the first.
bool names_any(const std::string& message, const std::set<std::string>& names) {
  for (std::size_t at = message.find(' '); at != std::string::npos;) {
    const std::size_t next = message.find(' ', at + 1);
    if (names.contains(message.substr(at + 1, next - at - 1))) return true;
    at = next;
  }
  return false;
}

/// Whether an attribute's value names something among `names`.
bool refers_to(const NodeAttribute& attribute, const std::set<std::string>& names) {
  const AttributeType type = attribute.schema->type;
  if (const Event* event = std::get_if<Event>(&attribute.value))
    return names.contains(event->target) || names.contains(event->source) || names_any(event->message, names);
  return type == AttributeType::reference && names.contains(std::get<std::string>(attribute.value));
}

/// Writes another name where an attribute's value has this one.
bool rename_in(NodeAttribute& attribute, const std::string& from, const std::string& to) {
  if (!refers_to(attribute, {from})) return false;
  if (Event* event = std::get_if<Event>(&attribute.value)) {
    if (event->target == from) event->target = to;
    if (event->source == from) event->source = to;
    for (std::size_t at = event->message.find(' '); at != std::string::npos;
         at = event->message.find(' ', at + 1)) {
      const std::size_t end = std::min(event->message.find(' ', at + 1), event->message.size());
      if (event->message.substr(at + 1, end - at - 1) == from)
        event->message.replace(at + 1, end - at - 1, to);
    }
  } else {
    attribute.value = to;
  }
  attribute.text.clear();
  return true;
}

}  // namespace

const Node* LiveScene::next_of(const Node& node) const {
  const Node* parent = parent_of(node);
  const Nodes& beside = parent ? parent->children : script_.nodes;
  const auto at = std::ranges::find_if(beside, [&](const Node& each) { return &each == &node; });
  return at == beside.end() || std::next(at) == beside.end() ? nullptr : &*std::next(at);
}

Nodes& LiveScene::nodes_beside(const Node* parent) {
  return parent ? writable(*parent).children : script_.nodes;
}

Status LiveScene::check_names(const Nodes& nodes) const {
  std::set<std::string> taken;
  Errors errors;
  for (const Node& node : nodes)
    visit_tree(node, [&](const Node& inside) {
      for (const std::string& name : names_of(inside)) {
        const Node* other = find(name);
        if (other && inside.schema->is_unique && other->schema == inside.schema)
          errors.push_back(error_at(inside.where, "the scene has a {} already; change its attributes instead",
                                    inside.schema->type));
        else if (other || !taken.insert(name).second)
          errors.push_back(
              error_at(inside.where, "the name \"{}\" is taken; names are unique in a scene", name));
      }
    });
  if (!errors.empty()) return errors;
  return Ok{};
}

/// Checks that nodes may stand in this place, and may come and go while the scene runs.
Status LiveScene::check_place(const Nodes& nodes, const Node* parent) const {
  const std::string& parent_type = parent ? parent->schema->type : top_level;
  for (const Node& node : nodes) {
    const std::vector<std::string>& parents = node.schema->stands_in;
    if (std::ranges::find(parents, parent_type) == parents.end())
      return error_at(node.where, "{} does not stand in {}; it stands in {}", node.schema->type,
                      parent ? parent_type : "the scene by itself", fmt::join(parents, " or "));
    const Node* fixed = nullptr;
    visit_tree(node, [&](const Node& inside) {
      if (inside.schema->is_laid_out_once) fixed = &inside;
    });
    if (fixed)
      return error_at(
          fixed->where,
          "a {} is laid out once, when the scene is loaded: change the script and open the scene again",
          fixed->schema->type);
  }
  return Ok{};
}

Status LiveScene::check_unused(const Node& node) const {
  std::set<std::string> names;
  std::set<const Node*> inside;
  visit_tree(node, [&](const Node& each) {
    inside.insert(&each);
    for (const std::string& name : names_of(each)) names.insert(name);
    if (each.schema->names_made)
      for (const std::string& name : each.schema->names_made(each)) names.insert(name);
  });
  const Node* user = nullptr;
  for (const Node& top : script_.nodes)
    visit_tree(top, [&](const Node& each) {
      if (inside.contains(&each)) return;
      for (const auto* attributes : {&each.attributes, &each.overrides})
        for (const NodeAttribute& attribute : *attributes)
          if (refers_to(attribute, names)) user = &each;
    });
  if (!user) return Ok{};
  const bool is_named = user->schema->find("name") && user->gives("name");
  return error_at(user->where, "a {}{} refers to what is to be removed; change or remove that first",
                  user->schema->type, is_named ? fmt::format(" (\"{}\")", user->text("name")) : "");
}

void LiveScene::know(Node& node, const Node* parent) {
  for (const std::string& name : names_of(node)) by_name_.emplace(name, &node);
  if (parent) parents_[&node] = parent;
  for (Node& child : node.children) know(child, &node);
}

/// Forgets the node and all nodes inside it. Its objects are those of its neighbours to come.
void LiveScene::forget(const Node& node) {
  visit_tree(node, [&](const Node& inside) {
    std::erase_if(by_name_, [&](const auto& named) { return named.second == &inside; });
    std::erase_if(settings_, [&](const Setting& setting) { return setting.node == &inside; });
    parents_.erase(&inside), objects_.erase(&inside), cameras_.erase(&inside), script_.frames.erase(&inside);
    changed_.erase(&inside), held_.erase(&inside), as_written_.erase(&writable(inside));
  });
}

/// Nodes are numbered in their order, parents before children; items follow.
void LiveScene::renumber(Scene& scene) {
  int last = -1, next = 0;
  for (const auto& [node, frame] : script_.frames) last = std::max(last, frame.number);
  std::vector<int> numbers(std::size_t(last + 1));
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = int(i);
  const auto number = [&](const Node& node) {
    const auto frame = script_.frames.find(&node);
    if (frame == script_.frames.end()) return;
    const int before = std::exchange(frame->second.number, next++);
    if (before >= 0) numbers[std::size_t(before)] = frame->second.number;
  };
  for (const Node& node : script_.nodes) visit_tree(node, number);
  for (const Node& node : added_) number(node);
  scene.room_data.renumber(numbers);
}

void LiveScene::follow_edit(Scene& scene) {
  ++edits_;
  for (const FollowStep& step : script_.registry->follow_steps()) step(*this, scene);
}

/// Builds nodes that stand in their place. What their parent makes by itself is there already.
Errors LiveScene::build_new(Scene& scene, const Node* parent, const std::set<const Node*>& made) {
  std::set<const Node*> inside;
  for (const Node* node : made) visit_tree(*node, [&](const Node& each) { inside.insert(&each); });
  const int parent_number = parent ? frame_of(*parent).number : -1;
  SceneBuilder builder(*script_.registry, std::move(script_.models));
  std::vector<Object> objects = std::exchange(scene.objects, {});
  std::vector<NamedCamera> cameras = std::exchange(scene.cameras, {});
  RoomDataSet of_parent = scene.room_data.take_made_by({parent_number, parent ? parent_number : -2});
  builder.scene = std::move(scene);
  builder.build_inside(parent, script_.nodes, made, script_.frames);
  scene = std::move(builder.scene);
  std::vector<Object> built_objects = std::exchange(scene.objects, std::move(objects));
  std::vector<NamedCamera> built_cameras = std::exchange(scene.cameras, std::move(cameras));
  if (parent) {
    scene.room_data.take_made_by({parent_number, parent_number});
    scene.room_data.put_back(std::move(of_parent));
  }
  const Errors errors = builder.errors();
  Script built = std::move(builder).take_script();
  script_.models = std::move(built.models);
  if (!errors.empty()) {
    for (const Node* node : made) scene.room_data.take_made_by(range_of(*node));
    return errors;
  }
  for (const Node* node : inside)  // parts of others have no frame
    if (const auto frame = built.frames.find(node); frame != built.frames.end())
      script_.frames[node] = frame->second;
    else
      script_.frames.erase(node);
  const std::size_t objects_before = scene.objects.size();
  for (const Node* node : made) {
    std::set<const Node*> own;
    visit_tree(*node, [&](const Node& each) { own.insert(&each); });
    const auto of_node = [&](auto& things, const std::vector<const Node*>& makers, auto& kept,
                             std::vector<const Node*>& kept_makers) {
      for (std::size_t i = 0; i < things.size(); ++i)
        if (own.contains(makers[i])) kept.push_back(std::move(things[i])), kept_makers.push_back(makers[i]);
    };
    std::vector<Object> node_objects;
    std::vector<NamedCamera> node_cameras;
    std::vector<const Node*> object_makers, camera_makers;
    of_node(built_objects, built.object_makers, node_objects, object_makers);
    of_node(built_cameras, built.camera_makers, node_cameras, camera_makers);
    put_objects(scene, std::move(node_objects), object_makers, *node);
    put_cameras(scene, node_cameras, camera_makers);
  }
  if (scene.objects.size() > objects_before) find_leaf_openness(scene);
  return {};
}

Status LiveScene::insert(Scene& scene, Nodes& nodes, const NodePosition& at) {
  assert(!at.before || parent_of(*at.before) == at.parent);
  if (nodes.empty()) return Ok{};
  if (Status status = check_place(nodes, at.parent); !status) return status;
  if (Status status = check_names(nodes); !status) return status;
  const auto is_part = [&](const Node& node) {
    return script_.registry->find(node.schema->type)->is_of_parent();
  };
  const Node* rebuilt = is_part(nodes.front()) && at.parent ? builder_of(*at.parent) : nullptr;
  if (is_part(nodes.front()) && !rebuilt)
    return error_at(nodes.front().where,
                    "a {} is part of the node around it, which stays as it is while the scene "
                    "runs: change the script and open the scene again",
                    nodes.front().schema->type);
  Nodes& beside = nodes_beside(at.parent);
  const auto place = std::ranges::find_if(beside, [&](const Node& each) { return &each == at.before; });
  std::set<const Node*> made;
  for (Node& node : nodes) {
    made.insert(&node);
    know(node, at.parent);
    visit_tree(node, [&](const Node& inside) { script_.frames[&inside] = {}; });
  }
  const auto first = nodes.begin();
  beside.splice(place, nodes);
  renumber(scene);
  if (Errors errors = rebuilt ? build_again(scene, *rebuilt) : build_new(scene, at.parent, made);
      !errors.empty()) {
    for (const Node* node : made) forget(*node);
    nodes.splice(nodes.begin(), beside, first, place);
    renumber(scene);
    return errors;
  }
  follow_edit(scene);
  return Ok{};
}

Result<const Node*> LiveScene::insert(Scene& scene, Node node, const NodePosition& at) {
  Nodes nodes;
  nodes.push_back(std::move(node));
  const Node* inserted = &nodes.front();
  if (Status status = insert(scene, nodes, at); !status) return status.errors();
  return inserted;
}

Result<std::vector<const Node*>> LiveScene::insert_script(Scene& scene, std::string_view script,
                                                          const NodePosition& at, const Roots& roots,
                                                          const std::string& file) {
  Result<Nodes> nodes = check_piece(script, file, at.parent ? at.parent->schema->type : top_level,
                                    script_.nodes, *script_.registry, roots);
  if (!nodes) return nodes.errors();
  std::vector<const Node*> inserted;
  for (const Node& node : *nodes) inserted.push_back(&node);
  if (Status status = insert(scene, *nodes, at); !status) return status.errors();
  return inserted;
}

/// Its objects are hidden and stay, its cameras and items go.
void LiveScene::take_out(Scene& scene, const Node& node, Nodes& into) {
  const Node* parent = parent_of(node);
  for (const int index : objects_of(node)) {
    scene.objects[std::size_t(index)].is_visible = false;
    spare_[parent].insert(index);
  }
  std::vector<int> gone;
  visit_tree(node, [&](const Node& inside) {
    if (const auto made = cameras_.find(&inside); made != cameras_.end())
      gone.insert(gone.end(), made->second.begin(), made->second.end());
  });
  std::ranges::sort(gone, std::greater());
  for (const int index : gone) {
    scene.cameras.erase(scene.cameras.begin() + index);
    for (auto& [maker, cameras] : cameras_)
      for (int& camera : cameras) camera -= camera > index;
  }
  if (is_built(node)) scene.room_data.take_made_by(range_of(node));
  forget(node);
  Nodes& beside = nodes_beside(parent);
  into.splice(into.end(), beside,
              std::ranges::find_if(beside, [&](const Node& each) { return &each == &node; }));
}

Status LiveScene::remove(Scene& scene, const Node& node) {
  if (node.schema->is_laid_out_once || node.schema->is_unique)
    return error_at(node.where, "a {} stays while the scene runs: change the script and open the scene again",
                    node.schema->type);
  if (Status status = check_unused(node); !status) return status;
  const Node* parent = parent_of(node);
  const NodePosition at{parent, next_of(node)};
  const bool is_part = script_.registry->find(node.schema->type)->is_of_parent();
  const Node* rebuilt = is_part && parent ? builder_of(*parent) : nullptr;
  if (is_part && !rebuilt)
    return error_at(node.where,
                    "a {} is part of the node around it, which stays as it is while the scene runs",
                    node.schema->type);
  take_out(scene, node, removed_);
  renumber(scene);
  if (rebuilt)
    if (Errors errors = build_again(scene, *rebuilt); !errors.empty()) {
      Nodes& beside = nodes_beside(parent);
      beside.splice(std::ranges::find_if(beside, [&](const Node& each) { return &each == at.before; }),
                    removed_, std::prev(removed_.end()));
      know(writable(node), parent);
      build_again(scene, *rebuilt);
      return errors;
    }
  follow_edit(scene);
  return Ok{};
}

Status LiveScene::put_back(Scene& scene, const Node& removed, const NodePosition& at) {
  const auto node = std::ranges::find_if(removed_, [&](const Node& each) { return &each == &removed; });
  assert(node != removed_.end() && "the node has been removed");
  Nodes nodes;
  nodes.splice(nodes.end(), removed_, node);
  Status status = insert(scene, nodes, at);
  if (!status) removed_.splice(removed_.end(), nodes);
  return status;
}

Status LiveScene::rename(Scene& scene, const Node& node, const std::string& name) {
  const AttributeSchema* attribute = node.schema->find("name");
  if (!attribute) return error_at(node.where, "a {} has no name", node.schema->type);
  const std::string before = node.text("name");
  if (name == before) return Ok{};
  if (name.empty()) return error_at(node.where, "the name is empty; give one");
  if (find(name)) return error_at(node.where, "the name \"{}\" is taken; names are unique in a scene", name);
  if (node.schema->is_laid_out_once || attribute->is_kept)
    return error_at(node.where, "a {} keeps its name while the scene runs", node.schema->type);
  for (Node& top : script_.nodes)
    visit_tree(top, [&](Node& each) {
      bool refers = false;
      for (auto* attributes : {&each.attributes, &each.overrides})
        for (NodeAttribute& given : *attributes)
          if (!before.empty() && refers_to(given, {before})) {
            if (is_built(each)) change(each);
            refers |= rename_in(given, before, name);
          }
    });
  for (auto& [changed, attributes] : as_written_)  // what comes back with another scenario
    for (NodeAttribute& given : attributes) {
      if (changed == &node && given.schema == attribute) given.value = name, given.text.clear();
      if (!before.empty()) rename_in(given, before, name);
    }
  std::erase_if(by_name_, [&](const auto& named) { return named.second == &node && named.first == before; });
  by_name_.emplace(name, &writable(node));
  set(node, "name", name);
  if (Errors errors = refresh(scene); !errors.empty()) return errors;
  follow_edit(scene);
  return Ok{};
}

Status LiveScene::move(Scene& scene, const Node& node, const NodePosition& to) {
  const Node* parent = parent_of(node);
  for (const Node* around = to.parent; around; around = parent_of(*around))
    if (around == &node) return error_at(node.where, "a {} cannot stand in itself", node.schema->type);
  if (to.before == &node) return Ok{};
  if (to.parent == parent) {
    Nodes& beside = nodes_beside(parent);
    const auto at = [&](const Node* wanted) {
      return std::ranges::find_if(beside, [&](const Node& each) { return &each == wanted; });
    };
    beside.splice(at(to.before), beside, at(&node));
    renumber(scene);
    follow_edit(scene);
    return Ok{};
  }
  const NodePosition from{parent, next_of(node)};
  Nodes taken;
  take_out(scene, node, taken);
  Status status = insert(scene, taken, to);
  if (!status) {
    const Status back = insert(scene, taken, from);
    assert(back.ok() && "it has stood there before");
  }
  return status;
}

}  // namespace parvis::scene
