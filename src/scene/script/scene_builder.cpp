#include "scene/script/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/camera_check.h"
#include "base/progress.h"
#include "scene/data/leaf_openness.h"
#include "scene/script/performer_file.h"

namespace parvis::scene {

namespace {

/// Groups inside groups multiply their scales: the numbers that remain must be ones that meshes can be
/// multiplied by.
bool is_usable(const glm::mat4& world_from_object) {
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 3; ++row)
      if (!(std::abs(world_from_object[column][row]) <= max_coordinate_m)) return false;
  return true;
}

Error misplaced(const std::string& name, const Node* node) {
  return error_at(node ? node->where : FileLocation{},
                  "\"{}\" would stand further than {:g} m away, or be as large; check position= and scale= "
                  "of it and of the groups around it",
                  name, max_coordinate_m);
}

}  // namespace

void SceneBuilder::add(Object object) {
  if (!is_usable(object.world_from_model)) return fail(misplaced(object.name, node_));
  scene.objects.push_back(std::move(object));
  object_makers_.resize(scene.objects.size(), node_);
}

void SceneBuilder::add_for(int maker, std::vector<Object> objects) {
  const auto of =
      std::ranges::find_if(frames_, [&](const auto& each) { return each.second.number == maker; });
  const Node* outer = std::exchange(node_, of == frames_.end() ? nullptr : of->first);
  for (Object& object : objects) add(std::move(object));
  node_ = outer;
}

void SceneBuilder::add(NamedCamera camera) {
  if (!parvis::is_usable(camera.camera)) return fail(misplaced(camera.name, node_));
  scene.cameras.push_back(std::move(camera));
  camera_makers_.resize(scene.cameras.size(), node_);
}

void SceneBuilder::build_one(const Node& node) {
  if (known_frames_ && !node.schema->can_be_built_again()) return;
  const int number = known_frames_ ? known_frames_->at(&node).number : next_number_++;
  const Node* outer = std::exchange(node_, &node);
  const int outer_number = std::exchange(node_number_, number);
  NodeFrame& frame = frames_[&node] = frame_;
  frame.number = number;
  if (!known_frames_)
    for (Error& told : replaced_performer_files(node)) warn(std::move(told));
  registry_.find(node.schema->type)->build(node, *this);
  node_ = outer, node_number_ = outer_number;
}

void SceneBuilder::build(const Nodes& nodes, const glm::mat4& parent_from_nodes, bool is_visible) {
  const NodeFrame outer = frame_;
  frame_.world_from_nodes = outer.world_from_nodes * parent_from_nodes;
  frame_.is_visible = outer.is_visible && is_visible;
  Progress progress("building the scene", nodes.size());
  for (const Node& node : nodes) {
    if (!wanted_ || wanted_->contains(&node)) {
      const auto* wanted = std::exchange(wanted_, nullptr);  // what stands in it is wanted, too
      build_one(node);
      wanted_ = wanted;
    }
    progress.advance();
  }
  frame_ = outer;
}

void SceneBuilder::build_again(const Node& node, const std::unordered_map<const Node*, NodeFrame>& frames) {
  known_frames_ = &frames;
  frame_ = frames.at(&node);
  build_one(node);
  for (const FinishStep& step : registry_.rebuild_steps()) step(*this);
}

void SceneBuilder::build_inside(const Node* parent, const Nodes& top, const std::set<const Node*>& wanted,
                                const std::unordered_map<const Node*, NodeFrame>& frames) {
  known_frames_ = &frames;
  wanted_ = &wanted;
  if (parent) {
    frame_ = frames.at(parent);
    build_one(*parent);
  } else {
    build(top);
  }
  wanted_ = nullptr;
  for (const FinishStep& step : registry_.rebuild_steps()) step(*this);
}

/// The number of the node that made an object; -1 where no node did.
int SceneBuilder::maker_number(std::size_t object) const {
  const Node* maker = object < object_makers_.size() ? object_makers_[object] : nullptr;
  return maker ? frames_.at(maker).number : -1;
}

const Node* SceneBuilder::find(const std::string& name) const {
  const auto found = makers().of_name.find(name);
  return found == makers().of_name.end() ? nullptr : found->second;
}

NodeRange SceneBuilder::range_of(const Node& node) const {
  const auto frame = frames_.find(&node);
  if (frame == frames_.end()) return {};  // a part of another node
  NodeRange range{frame->second.number, frame->second.number};
  for (const Node& inside : node.children) range.last = std::max(range.last, range_of(inside).last);
  return range;
}

std::vector<int> SceneBuilder::objects_of(const std::string& name) const {
  std::vector<int> objects;
  const std::function<void(const Node&)> add_from = [&](const Node& node) {
    if (const auto made = makers().made_by.find(&node); made != makers().made_by.end())
      objects.insert(objects.end(), made->second.begin(), made->second.end());
    for (const Node& inside : node.children) add_from(inside);
  };
  if (const Node* node = find(name)) add_from(*node);
  std::ranges::sort(objects);
  return objects;
}

const SceneBuilder::Makers& SceneBuilder::makers() const {
  if (named_.nodes == frames_.size() && named_.objects == object_makers_.size()) return named_;
  named_ = {};
  named_.nodes = frames_.size(), named_.objects = object_makers_.size();
  for (const auto& [node, frame] : frames_)
    if (node->schema->find("name") && node->gives("name")) named_.of_name.emplace(node->text("name"), node);
  for (std::size_t i = 0; i < object_makers_.size(); ++i) named_.made_by[object_makers_[i]].push_back(int(i));
  return named_;
}

Script SceneBuilder::take_script() && {
  object_makers_.resize(scene.objects.size(), nullptr);
  return {&registry_,        {}, std::move(frames_), std::move(object_makers_), std::move(camera_makers_),
          std::move(models_)};
}

std::shared_ptr<const Model> SceneBuilder::shared_model(
    const std::string& key, const std::function<std::shared_ptr<const Model>()>& make) {
  const auto known = models_.find(key);
  if (known != models_.end()) return known->second;
  return models_[key] = make();
}

void SceneBuilder::fail(const Errors& errors, const FileLocation& where) {
  for (const Error& error : errors)
    errors_.push_back(error.where.file.empty() ? Error{error.message, where}
                                               : error_at(where, "{}", to_string(error)));
}

Result<LoadedScene> SceneBuilder::finish() && {
  for (const FinishStep& step : registry_.finish_steps()) step(*this);
  if (!errors_.empty()) return std::move(errors_);
  find_leaf_openness(scene);
  Script script = std::move(*this).take_script();
  return LoadedScene{std::move(scene), std::move(warnings_), std::move(script)};
}

}  // namespace parvis::scene
