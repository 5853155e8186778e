// road, streets, paving: where vehicles drive; and the step that makes lanes of all roads when the script is
// built.
#include <algorithm>

#include "base/known_names.h"
#include "base/memory_budget.h"
#include "base/registries.h"
#include "land/heights/open_rooms.h"
#include "land/roads/paving.h"
#include "land/roads/road_builder.h"
#include "land/roads/road_data.h"
#include "land/roads/road_from_polygons.h"
#include "land/roads/shaped_terrain.h"
#include "room_list.h"
#include "scene/data/model_parts.h"
#include "scene/data/object_names.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"

namespace parvis::scene {
namespace {

using namespace attribute;

constexpr float m_s_per_km_h = 1.0f / 3.6f;
constexpr float speed_of_streets_km_h = 30.0f;  // where a file gives polygons alone

NodeSchema road_schema() {
  return {.type = "road",
          .help =
              "A street for vehicles. Where roads cross or touch they meet in a crossing; traffic keeps to "
              "the right.",
          .attributes = {text("name", "by which errors call it"),
                         path("path", "centre line on the ground; repeated, the pieces follow each other")
                             .in("m")
                             .between(-1e6, 1e6)
                             .required()
                             .repeatable(),
                         integer("lanes", "in each direction").between(1, 8).by_default("1"),
                         flag("one_way", "all lanes run from the first point to the last").by_default("0"),
                         number("lane_width", "of one lane").in("m").between(1, 20).by_default("3"),
                         number("speed_km_h", "the limit").in("km/h").between(1, 300).by_default("50")},
          .example = "road(path=\"0 0, 120 0, 200 40\", lanes=2, speed_km_h=30)",
          .is_laid_out_once = true};
}

void build_road(const Node& node, SceneBuilder& builder) {
  Road road;
  for (const glm::vec3& point : node.points("path"))
    road.path.emplace_back(builder.world_from_parent() * glm::vec4(point, 1.0f));
  road.lanes_each_way = int(node.integer("lanes"));
  road.is_one_way = node.flag("one_way");
  road.lane_width_m = float(node.number("lane_width"));
  road.speed_limit = float(node.number("speed_km_h")) * m_s_per_km_h;
  road.where = node.where_of("path");
  road.name = node.text("name");
  builder.add(PlannedRoad{std::move(road)});
}

NodeSchema streets_schema() {
  return {
      .type = "streets",
      .help =
          "Roads of a model: the centre lines that its file gives (OpenStreetMap), else along the middle of "
          "its road surfaces: of the parts that match target, those whose names do not speak of footpaths, "
          "cycle paths, parking or rails. Stands after the model.",
      .attributes = {text("of", "name of the model").required(),
                     text("target",
                          "name of objects, nodes or materials of the file; * and ? stand for any text and "
                          "any character")
                         .by_default("*Road*")
                         .repeatable(),
                     flag("paving",
                          "show them, as paving does, where the file gives centre lines without surfaces")
                         .by_default("1")},
      .example =
          "model(name=\"quarter\", file=\"quarter.city.json\")\n"
          "streets(of=\"quarter\")",
      .is_laid_out_once = true};
}

/// Adds the triangles of an object's matching parts, in the world; what a part is called says what it is for.
void add_road_polygons(const Object& object, const std::string& target, std::vector<RoadPolygon>& polygons) {
  const Model& model = *object.model;
  const std::vector<glm::mat4> model_from_node = rest_pose(model);
  for (const std::size_t index : matching_parts(model, target)) {
    const Part& part = model.parts[index];
    const std::string function = part.object + " " + model.materials[std::size_t(part.material)].name;
    const glm::mat4 world_from_mesh = object.world_from_model * model_from_node[std::size_t(part.node)];
    const std::vector<std::uint32_t>& indices = part.mesh.indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      RoadPolygon polygon{{{}}, function};
      for (std::size_t k = 0; k < 3; ++k)
        polygon.rings[0].emplace_back(world_from_mesh * glm::vec4(part.mesh.positions[indices[i + k]], 1.0f));
      polygons.push_back(std::move(polygon));
    }
  }
}

void add_given_roads(const Object& object, SceneBuilder& builder) {
  for (Road road : object.model->roads) {
    for (glm::vec3& point : road.path) point = glm::vec3(object.world_from_model * glm::vec4(point, 1.0f));
    builder.add(PlannedRoad{std::move(road)});
  }
}

void build_streets(const Node& node, SceneBuilder& builder) {
  const std::string name = node.text("of");
  const auto object = std::ranges::find(builder.scene.objects, name, &Object::name);
  if (object == builder.scene.objects.end())
    return builder.fail(error_at(node.where_of("of"), "no model called \"{}\" stands before this node{}",
                                 name, names_that_exist(name, scene::object_names(builder.scene))));
  if (!object->model->roads.empty()) {
    if (node.flag("paving")) builder.scene.data<Paving>().is_laid = true;
    return add_given_roads(*object, builder);
  }

  std::vector<RoadPolygon> polygons;
  if (!node.gives("target")) add_road_polygons(*object, node.text("target"), polygons);
  for (const NodeAttribute& attribute : node.attributes)
    if (attribute.schema->name == "target")
      add_road_polygons(*object, std::get<std::string>(attribute.value), polygons);
  const std::vector<Road> roads = roads_from_polygons(polygons);
  if (polygons.empty())
    builder.warn(error_at(node.where_of("of"), "streets: no part of \"{}\" matches target{}", name,
                          names_that_exist(node.text("target"), part_names(*object->model))));
  else if (roads.empty())
    builder.warn(
        error_at(node.where_of("of"),
                 "streets: of the {} triangles of \"{}\" that match target none make a street: they are "
                 "footpaths, cycle paths, parking or rails by name, too narrow, or as wide as long; "
                 "give the streets by road()",
                 polygons.size(), name));
  for (Road road : roads) {
    road.speed_limit = speed_of_streets_km_h * m_s_per_km_h;
    road.where = node.where_of("of");
    builder.add(PlannedRoad{std::move(road)});
  }
}

NodeSchema paving_schema() {
  return {.type = "paving",
          .help =
              "Shows the scene's roads: asphalt with markings and pavements, laid on the ground that is "
              "there (so paths "
              "need no "
              "exact heights: within 2.5 m is enough). Not for models that bring their own streets.",
          .example = "paving()",
          .is_unique = true,
          .is_laid_out_once = true};
}

void build_paving(const Node&, SceneBuilder& builder) { builder.scene.data<Paving>().is_laid = true; }

/// Makes lanes of the roads, on the ground. Where the script asks for carriageways, terrain is then cut and
/// filled for them, and they follow it; in plan they stay as they are, and so does traffic.
void finish_roads(SceneBuilder& builder) {
  std::vector<Road> roads;
  for (const PlannedRoad& planned : builder.scene.items<PlannedRoad>()) roads.push_back(planned.road);
  Result<RoadGraph> graph = build_road_graph(roads);
  if (!graph) return builder.fail(graph.errors());
  builder.scene.roads = *std::move(graph);
  if (!builder.errors().empty()) return;
  lay_lanes(builder.scene);
  if (!builder.scene.data<Paving>().is_laid) return;
  const Status enough = check_memory(paving_bytes(builder.scene.roads),
                                     fmt::format("paving {} lanes", builder.scene.roads.lanes.size()));
  const FileLocation where = roads.empty() ? FileLocation{} : roads.front().where;
  if (!enough) return builder.fail(enough.errors(), where);
  if (const Status shaped = shape_terrain(builder.scene, roads); !shaped)
    builder.warn({shaped.errors().front().message + "; it is neither cut nor filled", where});
  pave_laid_lanes(builder.scene);
}

}  // namespace

}  // namespace parvis::scene

/// Adds the node types, and the step that makes lanes of roads.
void parvis::roads::register_room(Registries& registries) {
  using namespace parvis::scene;
  NodeRegistry& registry = registries.get<NodeRegistry>();
  registry.add(road_schema(), build_road);
  registry.add(streets_schema(), build_streets);
  registry.add(paving_schema(), build_paving);
  // The ground is complete here: terrain_plane, which dressing lays, comes before roads.
  registry.add_finish_step([](SceneBuilder& builder) { open_rooms(builder.scene); });
  registry.add_finish_step(finish_roads);
}
