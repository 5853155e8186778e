#include "planning/plan_drawing/scene_plan.h"

#include <algorithm>
#include <set>

#include "base/colour.h"
#include "capture/trees/scene_tree.h"
#include "land/heights/city_surfaces.h"
#include "land/heights/place_heights.h"
#include "life/vegetation/scene_plant.h"
#include "planning/plan_drawing/placed_blocks.h"
#include "planning/plan_drawing/plan_lines.h"
#include "scene/data/surroundings.h"

namespace parvis::plan_drawing {
namespace {

constexpr float margin_m = 4.0f;     // of the ground's heights
constexpr float flat_m = 0.05f;      // what is lower lies on the ground: paving, markings
constexpr double min_tree_m = 0.25;  // the radius of a crown that is drawn at least

/// Words in names of parts whose rims are the edges of roads and squares.
constexpr std::array road_words{"carriageway", "kerb", "Road", "TrafficArea", "TransportSquare", "Railway"};

bool is_road(const std::string& part) {
  return std::ranges::any_of(road_words,
                             [&](const char* word) { return part.find(word) != std::string::npos; });
}

bool is_of_ground(const std::string& part) {
  return scene::is_ground(part) || part.find("pavement") != std::string::npos ||
         part.find("markings") != std::string::npos;
}

/// Whether the object shows an object of a design: it has its name, alone or before a space.
bool is_placed(const scene::Object& object, const std::set<std::string>& placed) {
  return placed.contains(object.name) || placed.contains(object.name.substr(0, object.name.find(' ')));
}

/// Gathers the segments of the scene's objects.
class Cutter {
 public:
  Cutter(const scene::Scene& scene, ScenePlan& plan) : ground_(scene, {}, margin_m), plan_(plan) {}

  void add(const scene::Object& object) {
    const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(*object.model) : object.pose;
    std::vector<Segment> walls, roads;
    std::vector<glm::dvec3> low;
    bool is_low = true;
    for (std::size_t i = 0; i < object.model->parts.size(); ++i) {
      const scene::Part& part = object.model->parts[i];
      const scene::Material& material = object.materials()[std::size_t(part.material)];
      if (part.is_backdrop || material.alpha_mode != scene::Alpha::opaque) continue;  // leaves, panes
      const glm::mat4 world_from_mesh = object.world_from_model * pose[std::size_t(part.node)];
      if (is_road(part.object)) add_open_edges(object.mesh(i), world_from_mesh, roads);
      if (is_road(part.object) || is_of_ground(part.object)) continue;
      add_section(
          object.mesh(i), world_from_mesh, [this](glm::vec2 at) { return ground_.at(at); }, section_height_m,
          walls);
      is_low = is_low && note_low(object.mesh(i), world_from_mesh, low);
    }
    add_lines(PlanLayer::road, roads);
    add_lines(PlanLayer::wall, walls);
    if (!walls.empty() || !is_low || low.empty()) return;
    if (std::vector<glm::dvec3> outline = convex_outline(std::move(low)); !outline.empty())
      plan_.lines.push_back({PlanLayer::thing, std::move(outline)});
  }

  float ground(glm::vec2 at) const { return ground_.at(at); }

 private:
  /// Notes the points of a mesh that stands on the ground below the section; false where it hangs above.
  bool note_low(const Mesh& mesh, const glm::mat4& world_from_mesh, std::vector<glm::dvec3>& low) const {
    const std::size_t before = low.size();
    float highest = 0.0f;
    for (const glm::vec3& position : mesh.positions) {
      const glm::vec3 point(world_from_mesh * glm::vec4(position, 1.0f));
      highest = std::max(highest, point.z - ground_.at(glm::vec2(point)));
      if (highest > section_height_m) return false;
      low.emplace_back(point);
    }
    if (highest < flat_m) low.resize(before);
    return true;
  }

  void add_lines(PlanLayer layer, const std::vector<Segment>& segments) {
    for (std::vector<glm::dvec3>& line : joined(segments))
      plan_.lines.push_back({.layer = layer, .points = std::move(line)});
  }

  scene::PlaceHeights ground_;
  ScenePlan& plan_;
};

/// A tree of a box in a frame whose foot lies at `foot`.
PlanTree tree_of(const Bounds& box, glm::vec3 foot, const glm::mat4& world_from_tree, std::string name) {
  const Bounds in_world = transformed(world_from_tree, box);
  PlanTree tree;
  tree.name = std::move(name);
  tree.position = glm::dvec3(world_from_tree * glm::vec4(foot, 1.0f));
  tree.crown_radius_m = std::max(0.25 * double(in_world.size().x + in_world.size().y), min_tree_m);
  tree.height_m = double(in_world.size().z);
  return tree;
}

/// Does the plant belong to an object of a design, which the plan shows as such?
bool grows_on_placed(const vegetation::ScenePlant& plant, const ScenePlan& plan) {
  constexpr double same_foot_m = 0.01;
  const glm::dvec2 foot{glm::vec2(plant.world_from_plant[3])};
  return std::ranges::any_of(plan.placed, [&](const design::PlacedObject& object) {
    return glm::distance(glm::dvec2(object.position), foot) < same_foot_m;
  });
}

void add_plants(const scene::Scene& scene, ScenePlan& plan) {
  for (const trees::SceneTree& tree : trees::scene_trees(scene))
    if (tree.is_visible)
      plan.trees.push_back(tree_of(tree.tree->box, tree.tree->foot, tree.world_from_tree,
                                   fmt::format("tree {}", plan.trees.size() + 1)));
  for (const vegetation::ScenePlant& plant : vegetation::scene_plants(scene)) {
    if (!plant.is_visible || grows_on_placed(plant, plan)) continue;
    const vegetation::PlantShape& shape = *plant.shape;
    if (shape.kind().habit == vegetation::Habit::tree) {
      plan.trees.push_back(
          tree_of(shape.bounds, glm::vec3(0.0f), plant.world_from_plant, std::string(shape.kind().name)));
      continue;
    }
    PlanLine outline{PlanLayer::plant, {}};
    const Bounds& box = shape.bounds;
    for (const glm::vec2 corner : {glm::vec2(box.min), glm::vec2(box.max.x, box.min.y), glm::vec2(box.max),
                                   glm::vec2(box.min.x, box.max.y), glm::vec2(box.min)})
      outline.points.emplace_back(glm::vec3(plant.world_from_plant * glm::vec4(corner, 0.0f, 1.0f)));
    plan.lines.push_back(std::move(outline));
  }
}

/// Lines, texts and objects of drawings under the place, on the layers that are shown.
void add_drawings(const scene::Scene& scene, ScenePlan& plan) {
  for (const PlacedDrawing& placed : scene.items<PlacedDrawing>()) {
    if (!placed.is_visible) continue;
    for (const formats::DrawingLine& line : placed.drawing->lines) {
      if (!placed.shows_layer[std::size_t(line.layer)]) continue;
      PlanLine drawn{.layer = PlanLayer::drawing,
                     .points = {},
                     .colour = linear_from_srgb8(line.colour.x, line.colour.y, line.colour.z),
                     .width_m = line.width_m};
      for (const glm::dvec3& point : line.points) drawn.points.emplace_back(placed.in_world(point));
      plan.lines.push_back(std::move(drawn));
    }
    const float scale = glm::length(glm::vec3(placed.world_from_plan[0]));
    const glm::vec4& x = placed.world_from_plan[0];
    const double turn_deg = glm::degrees(std::atan2(double(x.y), double(x.x)));
    for (const formats::DrawingText& text : placed.drawing->texts)
      if (placed.shows_layer[std::size_t(text.layer)])
        plan.texts.push_back({text.text, glm::dvec2(glm::vec2(placed.in_world(text.position))),
                              double(scale) * text.height_m, text.angle_deg + turn_deg, text.anchor});
    for (design::PlacedObject& object : placed_blocks(placed)) plan.placed.push_back(std::move(object));
  }
}

void note_left_out(const scene::Scene& scene, std::size_t moving, const design::Words& words,
                   ScenePlan& plan) {
  plan.left_out.push_back(words(
      "What is higher than 1 m above the ground and does not reach down to it (awnings, balconies, bridges, "
      "roofs), and the slopes of the ground."));
  if (moving > 0) plan.left_out.push_back(words.format("{} things that move (vehicles, people).", moving));
  for (const scene::TracedKind& kind : scene.traced_kinds) {
    const bool is_shown =
        kind.name.find("tree") != std::string::npos || kind.name.find("plant") != std::string::npos;
    if (const int count = kind.count(scene); count > 0 && !is_shown)
      plan.left_out.push_back(words.format("{} of the kind \"{}\".", count, kind.name));
  }
}

}  // namespace

glm::dvec2 ScenePlan::middle() const {
  glm::dvec2 min(std::numeric_limits<double>::max()), max(-min);
  const auto note = [&](glm::dvec2 point) { min = glm::min(min, point), max = glm::max(max, point); };
  for (const design::PlacedObject& object : placed) note(glm::dvec2(object.position));
  if (placed.empty()) {
    for (const PlanLine& line : lines)
      for (const glm::dvec3& point : line.points) note(glm::dvec2(point));
    for (const PlanTree& tree : trees) note(glm::dvec2(tree.position));
  }
  return min.x > max.x ? glm::dvec2(0.0) : 0.5 * (min + max);
}

ScenePlan plan_of(const scene::Scene& scene, std::vector<design::PlacedObject> placed,
                  const std::vector<design::Measurement>& measured, const design::Words& words) {
  ScenePlan plan;
  for (const design::Measurement& each : measured) plan.measured.push_back(PlanMeasure::of(each));
  plan.origin = scene.origin, plan.map = scene.map;
  std::set<std::string> names;
  for (const design::PlacedObject& object : placed) names.insert(object.name);
  std::erase_if(placed, [](const design::PlacedObject& object) { return !object.is_visible; });
  plan.placed = std::move(placed);
  Cutter cutter(scene, plan);
  std::size_t moving = 0;
  for (const scene::Object& object : scene.objects) {
    if (!object.is_visible || scene::surrounds_place(scene, object) || is_placed(object, names)) continue;
    if (object.is_dynamic)
      ++moving;
    else
      cutter.add(object);
  }
  add_plants(scene, plan);
  add_drawings(scene, plan);
  note_left_out(scene, moving, words, plan);
  return plan;
}

}  // namespace parvis::plan_drawing
