#include "scene/script/live_scene.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

#include "base/known_names.h"
#include "base/progress.h"
#include "scene/data/leaf_openness.h"
#include "scene/script/spelling.h"

namespace parvis::scene {
namespace {

// Scenarios before one that extends them. Each is tried with all before it: the work grows with their
// product.
constexpr std::size_t max_extended = 256;

template <class Nodes, class Visit>
void for_each_inside(Nodes& nodes, const Visit& visit) {
  for (auto& node : nodes) {
    visit(node);
    for_each_inside(node.children, visit);
  }
}

template <class Visit>
void for_each_from(const Node& node, const Visit& visit) {
  visit(node);
  for_each_inside(node.children, visit);
}

bool is_scenario(const Node& node) { return node.schema->type == "scenario"; }

/// Gives an attribute a value, and clears those that it stands in place of.
void give(Node& node, const std::string& attribute, AttributeValue value) {
  const std::vector<std::string>& replaced = node.schema->find(attribute)->in_place_of;
  std::erase_if(node.attributes, [&](const NodeAttribute& each) {
    return std::find(replaced.begin(), replaced.end(), each.schema->name) != replaced.end();
  });
  node.set(attribute, std::move(value));
}

}  // namespace

LiveScene::LiveScene(Script script) : script_(std::move(script)) {
  for_each_inside(script_.nodes, [this](Node& node) {
    if (node.schema->is_unique)
      for (const std::string& name : unique_names(node.schema->type)) by_name_.emplace(name, &node);
    if (node.schema->find("name") && node.gives("name")) by_name_.emplace(node.text("name"), &node);
    for (const Node& child : node.children) parents_.emplace(&child, &node);
  });
  for (std::size_t i = 0; i < script_.object_makers.size(); ++i)
    if (const Node* maker = script_.object_makers[i]) objects_[maker].push_back(int(i));
  for (std::size_t i = 0; i < script_.camera_makers.size(); ++i)
    if (const Node* maker = script_.camera_makers[i]) cameras_[maker].push_back(int(i));
}

const Node* LiveScene::find(const std::string& name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : found->second;
}

std::vector<int> LiveScene::objects_of(const Node& node) const {
  std::vector<int> all;
  for_each_from(node, [&](const Node& each) {
    if (const auto made = objects_.find(&each); made != objects_.end())
      all.insert(all.end(), made->second.begin(), made->second.end());
  });
  return all;
}

const Node* LiveScene::maker_of(const Scene& scene, int object) const {
  for (const auto& [node, made] : objects_)
    if (std::find(made.begin(), made.end(), object) != made.end()) return node;
  const std::string& name = scene.objects[std::size_t(object)].name;
  const Node* maker = nullptr;
  for_each_inside(script_.nodes, [&](const Node& node) {
    if (!node.schema->names_made) return;
    const std::vector<std::string> names = node.schema->names_made(node);
    if (std::find(names.begin(), names.end(), name) != names.end()) maker = &node;
  });
  return maker;
}

const Node* LiveScene::parent_of(const Node& node) const {
  const auto parent = parents_.find(&node);
  return parent == parents_.end() ? nullptr : parent->second;
}

const NodeFrame& LiveScene::frame_of(const Node& node) const {
  static const NodeFrame world;
  const auto found = script_.frames.find(&node);
  return found == script_.frames.end() ? world : found->second;
}

/// All nodes are ours to change; others only read them.
Node& LiveScene::writable(const Node& node) { return const_cast<Node&>(node); }

/// The node, to be changed now and rebuilt at the next refresh.
Node& LiveScene::change(const Node& node) {
  changed_.try_emplace(&node, node.attributes);
  return writable(node);
}

void LiveScene::set(const Node& node, const std::string& attribute, AttributeValue value) {
  std::erase_if(settings_, [&](const Setting& earlier) {
    return earlier.node == &node && earlier.attribute == attribute;
  });
  settings_.push_back({&node, attribute, value});
  give(change(node), attribute, std::move(value));
}

void LiveScene::set_all(const Node& node, std::vector<NodeAttribute> attributes) {
  std::erase_if(settings_, [&](const Setting& earlier) { return earlier.node == &node; });
  change(node).attributes = std::move(attributes);
}

const Node& LiveScene::unique_node(const std::string& type) {
  if (const Node* node = find("%" + type)) return *node;
  const NodeSchema& schema = script_.registry->find(type)->schema;
  assert(schema.is_unique);
  Node& node = added_.emplace_back();
  node.schema = &schema;
  by_name_.emplace("%" + type, &node);
  int last = -1;
  for (const auto& [other, frame] : script_.frames) last = std::max(last, frame.number);
  script_.frames[&node].number = last + 1;
  return node;
}

Status LiveScene::hold(const Node& node, const std::string& attribute, const std::string& text) {
  const AttributeSchema* schema = node.schema->find(attribute);
  assert(schema && "the node's schema has no such attribute");
  Result<AttributeValue> value = parse_value(*schema, text, Roots(""), {});
  if (!value) return value.errors();
  held_[&node][attribute] = *value;
  set(node, attribute, *std::move(value));
  return Ok{};
}

bool LiveScene::receive(const Node& node, const Message& message) {
  const std::string& name = message.schema->name;
  const auto show = [this](const Node& target, bool is_visible) { set(target, "visible", is_visible); };
  const bool can_hide = node.schema->find("visible") != nullptr;
  if (can_hide && (name == "show" || name == "hide" || name == "toggle")) {
    const Node* target =
        message.arguments.empty() ? &node : find(std::get<std::string>(message.arguments.front()));
    show(*target, name == "toggle" ? !target->flag("visible") : name == "show");
  } else if (name == "only") {
    const Node* chosen = find(std::get<std::string>(message.arguments.front()));
    for (const Node& child : node.children) {
      bool holds_chosen = false;
      for_each_from(child, [&](const Node& inside) { holds_chosen |= &inside == chosen; });
      if (child.schema->find("visible")) show(child, holds_chosen);
    }
  } else if (const AttributeSchema* attribute = node.schema->find(name); attribute && attribute->is_live) {
    set(node, attribute->name, message.arguments.front());
  } else {
    return false;
  }
  return true;
}

std::vector<const Node*> LiveScene::scenarios() const {
  std::vector<const Node*> all;
  for_each_inside(script_.nodes, [&](const Node& node) {
    if (is_scenario(node)) all.push_back(&node);
  });
  return all;
}

/// The scenario that it extends, then its own overrides and nodes.
void LiveScene::change_by(const Node& scenario) {
  if (scenario.gives("extends")) change_by(*find(scenario.text("extends")));
  Node& chosen = change(scenario);
  as_written_.try_emplace(&chosen, chosen.attributes);
  chosen.set("chosen", true);
  for (const Node& child : scenario.children) {
    if (child.schema->takes_attributes_of.empty()) continue;
    Node& target = change(*find(child.text("of")));
    as_written_.try_emplace(&target, target.attributes);
    for (const NodeAttribute& attribute : child.overrides)
      std::erase_if(target.attributes, [&](const auto& each) { return each.schema == attribute.schema; });
    target.attributes.insert(target.attributes.end(), child.overrides.begin(), child.overrides.end());
  }
}

Status LiveScene::choose(Scene& scene, const std::string& wanted) {
  const std::string name = wanted == base_scene && !find(wanted) ? "" : wanted;
  const Node* chosen = name.empty() ? nullptr : find(name);
  if (!name.empty() && (!chosen || !is_scenario(*chosen))) {
    std::vector<std::string> known;
    for (const Node* each : scenarios()) known.push_back(each->text("name"));
    return error("the scene has no scenario \"{}\"{}", name, names_that_exist(name, known));
  }
  for (auto& [node, attributes] : as_written_) change(*node).attributes = std::move(attributes);
  as_written_.clear();
  scenario_ = name;
  if (chosen) change_by(*chosen);
  for (const auto& [node, values] : held_)
    for (const auto& [attribute, value] : values) set(*node, attribute, value);
  settings_.clear();  // all of the scenario, or nothing
  if (Errors errors = refresh(scene); !errors.empty()) return errors;
  return Ok{};
}

Status LiveScene::prepare_scenarios(Scene& scene) {
  Errors errors;
  const Node* first = nullptr;
  for (const Node* scenario : scenarios()) {
    if (scenario->flag("chosen")) {
      if (first)
        errors.push_back(error_at(scenario->where_of("chosen"),
                                  "the scene begins with scenario \"{}\" already", first->text("name")));
      first = scenario;
    }
    std::set<const Node*> chain{scenario};
    const Node* base = scenario;
    while (base->gives("extends") && chain.size() <= max_extended + 1 &&
           chain.insert(find(base->text("extends"))).second)
      base = find(base->text("extends"));
    // One message for all of a chain, which may be of any length.
    if (chain.size() > max_extended + 1)
      return error_at(scenario->where_of("extends"),
                      "scenario \"{}\" extends one that extends one, and so on, more than {} times; let it "
                      "extend one with fewer before it",
                      scenario->text("name"), max_extended);
    if (base->gives("extends"))
      errors.push_back(error_at(scenario->where_of("extends"), "scenarios extend each other in a circle"));
  }
  if (!errors.empty()) return errors;
  const std::string begins = first ? first->text("name") : "";
  if (first) set(*first, "chosen", false);
  const std::vector<const Node*> all = scenarios();
  Progress progress("trying scenarios", all.size());
  for (const Node* scenario : all) {
    if (Status status = choose(scene, scenario->text("name")); !status)
      errors.insert(errors.end(), status.errors().begin(), status.errors().end());
    progress.advance();
  }
  if (errors.empty()) return choose(scene, begins);
  return errors;
}

/// The node that is rebuilt where this one changes: itself, or the one around it that it is a part of.
/// Null for what stays as it was when the scene was loaded.
const Node* LiveScene::builder_of(const Node& node) const {
  if (is_built(node)) return &node;
  const Node* parent = parent_of(node);
  const bool is_of_parent = script_.registry->find(node.schema->type)->is_of_parent();
  return is_of_parent && parent ? builder_of(*parent) : nullptr;
}

Errors LiveScene::refresh(Scene& scene) {
  Errors errors;
  std::map<const Node*, std::vector<const Node*>> changed_by_builder;
  auto before = std::exchange(changed_, {});
  const std::vector<Setting> settings = std::exchange(settings_, {});
  for (const auto& [node, attributes] : before) changed_by_builder[builder_of(*node)].push_back(node);
  for (const auto& [builder, changed] : changed_by_builder) {
    const std::vector<const Node*>& nodes = changed;
    Errors met;
    if (builder) {
      met = build_again(scene, *builder);
    } else {
      for (const Node* node : nodes)
        met.push_back(error_at(node->where,
                               "the {} is part of the node around it and stays as it is while the scene runs",
                               node->schema->type));
    }
    if (!met.empty()) {
      for (const Node* node : nodes) writable(*node).attributes = std::move(before[node]);
      std::vector<Setting> of_nodes;
      std::ranges::copy_if(settings, std::back_inserter(of_nodes), [&](const Setting& setting) {
        return std::ranges::find(nodes, setting.node) != nodes.end();
      });
      if (builder && of_nodes.size() > 1) met = apply_singly(scene, *builder, of_nodes);
    }
    errors.insert(errors.end(), met.begin(), met.end());
  }
  return errors;
}

/// One value that cannot be built does not take with it what other messages have set at the same time.
Errors LiveScene::apply_singly(Scene& scene, const Node& builder, const std::vector<Setting>& settings) {
  Errors errors;
  for (const Setting& setting : settings) {
    Node& node = writable(*setting.node);
    const std::vector<NodeAttribute> before = node.attributes;
    give(node, setting.attribute, setting.value);
    const Errors met = build_again(scene, builder);
    if (!met.empty()) node.attributes = before;
    errors.insert(errors.end(), met.begin(), met.end());
  }
  return errors;
}

/// Numbers of the node and of those inside it that were built.
NodeRange LiveScene::range_of(const Node& node) const {
  NodeRange range{frame_of(node).number, frame_of(node).number};
  for_each_from(node,
                [&](const Node& inside) { range.last = std::max(range.last, frame_of(inside).number); });
  return range;
}

/// A node that stands once is written in place; objects, cameras and items are built aside, and then replace
/// those that the node had made.
Errors LiveScene::build_again(Scene& scene, const Node& node) {
  const NodeRange range = range_of(node);
  SceneBuilder builder(*script_.registry, std::move(script_.models));
  std::vector<Object> objects = std::exchange(scene.objects, {});
  std::vector<NamedCamera> cameras = std::exchange(scene.cameras, {});
  RoomDataSet items = scene.room_data.take_made_by(range);
  builder.scene = std::move(scene);
  builder.build_again(node, script_.frames);
  scene = std::move(builder.scene);
  std::vector<Object> built_objects = std::exchange(scene.objects, std::move(objects));
  const std::vector<NamedCamera> built_cameras = std::exchange(scene.cameras, std::move(cameras));

  Errors errors = builder.errors();
  Script built = std::move(builder).take_script();
  script_.models = std::move(built.models);
  if (!errors.empty()) {
    scene.room_data.take_made_by(range);
    scene.room_data.put_back(std::move(items));
    return errors;
  }
  for (auto& [inside, frame] : built.frames) script_.frames[inside] = frame;
  const std::size_t objects_before = scene.objects.size();
  put_objects(scene, std::move(built_objects), built.object_makers, node);
  put_cameras(scene, built_cameras, built.camera_makers);
  follow_objects(scene, objects_before);
  return {};
}

/// Updates data that are kept by model or found out about all objects when there are new ones.
void LiveScene::follow_objects(Scene& scene, std::size_t objects_before) {
  if (scene.objects.size() == objects_before) return;
  find_leaf_openness(scene);
  for (const FollowStep& step : script_.registry->follow_steps()) step(*this, scene);
}

/// Each object takes the place of one that the same node made of the same model before, or that a removed
/// node beside it left, or a new one; places that are left over are hidden.
void LiveScene::put_objects(Scene& scene, std::vector<Object> built, const std::vector<const Node*>& makers,
                            const Node& node) {
  std::set<int> free;
  for_each_from(node, [&](const Node& each) {
    // What is laid out once is not rebuilt: it is shown or hidden where it stands.
    const bool stays = each.schema->is_laid_out_once && each.schema->find("visible") != nullptr;
    const bool is_visible = stays && frame_of(each).is_visible && each.flag("visible");
    for (const int index : objects_[&each]) {
      if (!stays) free.insert(index);
      scene.objects[std::size_t(index)].is_visible = is_visible;
    }
  });
  std::set<int>& spare = spare_[parent_of(node)];
  for (std::size_t i = 0; i < built.size(); ++i) {
    const auto fits = [&](int index) {
      const Object& object = scene.objects[std::size_t(index)];
      const bool both_play = (object.played.animation == no_index) == (built[i].played.animation == no_index);
      return object.model == built[i].model && object.paint == built[i].paint && both_play;
    };
    std::vector<int>& places = objects_[makers[i]];
    const auto place =
        std::ranges::find_if(places, [&](int index) { return free.contains(index) && fits(index); });
    const auto left = place != places.end() ? spare.end() : std::ranges::find_if(spare, [&](int index) {
      const Object& object = scene.objects[std::size_t(index)];
      return fits(index) && object.is_dynamic == built[i].is_dynamic &&
             object.takes_reflection == built[i].takes_reflection;
    });
    if (place == places.end() && left == spare.end()) {
      places.push_back(int(scene.objects.size()));
      scene.objects.push_back(std::move(built[i]));
      continue;
    }
    const int index = place != places.end() ? *place : *left;
    Object& object = scene.objects[std::size_t(index)];
    object.name = std::move(built[i].name);
    object.world_from_model = built[i].world_from_model;
    object.played = built[i].played;
    object.is_visible = built[i].is_visible;
    free.erase(index);
    if (place == places.end()) {
      places.push_back(index);
      spare.erase(left);
    }
  }
}

void LiveScene::put_cameras(Scene& scene, const std::vector<NamedCamera>& built,
                            const std::vector<const Node*>& makers) {
  std::map<const Node*, std::size_t> used;
  for (std::size_t i = 0; i < built.size(); ++i) {
    std::vector<int>& places = cameras_[makers[i]];
    if (const std::size_t nth = used[makers[i]]++; nth < places.size()) {
      scene.cameras[std::size_t(places[nth])] = built[i];
    } else {
      places.push_back(int(scene.cameras.size()));
      scene.cameras.push_back(built[i]);
    }
  }
}

}  // namespace parvis::scene
