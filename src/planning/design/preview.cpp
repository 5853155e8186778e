#include "planning/design/preview.h"

#include <algorithm>

#include "life/vegetation/plant_drawable.h"
#include "life/vegetation/scene_plant.h"
#include "scene/script/scene_builder.h"

namespace parvis::design {
namespace {

constexpr glm::vec3 refused_colour(0.55f, 0.03f, 0.02f);  // linear

}  // namespace

void Preview::clear() {
  names_.clear(), taken_.clear();
  for (scene::Object& object : shown_.objects) object.is_visible = false;
  shown_.data<vegetation::ScenePlants>() = {};
}

Status Preview::show(const Changes& changes, const scene::Node* design, std::size_t refused) {
  clear();
  scene::Nodes nodes;
  std::set<std::string> in_red;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const Change& change = changes[i];
    if (change.before) taken_.push_back(change.before->text("name"));
    if (!change.after) continue;
    nodes.push_back(*change.after), names_.push_back(change.after->text("name"));
    if (i < refused) in_red.insert(names_.back());
  }
  scene::SceneBuilder builder(live_.registry(), std::move(models_));
  builder.scene.data<Kinds>() = place_.data<Kinds>();
  builder.scene.data<vegetation::PlantCache>() = place_.data<vegetation::PlantCache>();
  for (const auto& [recipe, shape] : shown_.data<vegetation::PlantCache>().shapes)
    builder.scene.data<vegetation::PlantCache>().shapes.emplace(recipe, shape);
  builder.build(nodes, design ? live_.frame_of(*design).world_from_nodes : glm::mat4(1.0f));
  const Errors errors = builder.errors();
  scene::Scene built = std::move(builder.scene);
  models_ = std::move(builder).take_script().models;
  shown_.data<vegetation::PlantCache>() = built.data<vegetation::PlantCache>();
  if (!errors.empty()) {
    clear();
    return errors;
  }
  shown_.traced_kinds = place_.traced_kinds;
  shown_.data<vegetation::PlantDetail>() = place_.data<vegetation::PlantDetail>();
  shown_.data<vegetation::ScenePlants>() = built.data<vegetation::ScenePlants>();
  put_objects(std::move(built.objects), in_red);
  return Ok{};
}

/// Each takes the place of a hidden one of the same model and paint, so that nothing is uploaded again.
void Preview::put_objects(std::vector<scene::Object> objects, const std::set<std::string>& refused) {
  for (scene::Object& object : objects) {
    if (refused.contains(object.name)) {
      std::shared_ptr<const std::vector<scene::Material>>& red = red_[object.model.get()];
      if (!red) {
        std::vector<scene::Material> materials = object.materials();
        for (scene::Material& material : materials) material.base_colour = refused_colour;
        red = std::make_shared<const std::vector<scene::Material>>(std::move(materials));
      }
      object.paint = red;
    }
    const auto free = std::ranges::find_if(shown_.objects, [&](const scene::Object& old) {
      return !old.is_visible && old.model == object.model && old.paint == object.paint;
    });
    object.is_visible = true;
    if (free != shown_.objects.end())
      *free = std::move(object);
    else
      shown_.objects.push_back(std::move(object));
  }
}

std::vector<std::uint8_t> Preview::what_stays() const {
  std::size_t count = place_.objects.size(), first_plant = 0;
  const std::string plants = vegetation::traced_plants().name;
  scene::for_each_traced_kind(place_, [&](const scene::TracedKind& kind, int first_thing) {
    count = std::max(count, std::size_t(first_thing) + std::size_t(kind.count(place_)));
    if (kind.name == plants) first_plant = std::size_t(first_thing);
  });
  std::vector<std::uint8_t> stays(count, 1);
  const std::set<std::string> taken(taken_.begin(), taken_.end());
  for (std::size_t i = 0; i < place_.objects.size(); ++i)
    if (taken.contains(place_.objects[i].name)) stays[i] = 0;
  if (first_plant == 0) return stays;
  const std::vector<int>& makers = place_.data<vegetation::ScenePlants>().makers;
  for (const std::string& name : taken) {
    const scene::Node* node = live_.find(name);
    if (!node) continue;
    const scene::NodeRange range = live_.range_of(*node);
    for (std::size_t plant = 0; plant < makers.size(); ++plant)
      if (makers[plant] >= range.first && makers[plant] <= range.last) stays[first_plant + plant] = 0;
  }
  return stays;
}

}  // namespace parvis::design
