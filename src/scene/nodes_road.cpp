// road, streets, paving, traffic: where vehicles drive, and which.
#include <algorithm>

#include "scene/material_change.h"
#include "scene/model_assembly.h"
#include "scene/model_node.h"
#include "scene/node_registry.h"
#include "scene/nodes.h"
#include "scene/placement.h"
#include "scene/road_from_polygons.h"
#include "scene/scene_builder.h"

namespace parvis::scene {
namespace {

constexpr float m_s_per_km_h = 1.0f / 3.6f;

NodeSchema road_schema() {
  return {.type = "road",
          .help =
              "A street for vehicles. Where roads cross or touch they meet in a crossing; traffic keeps to "
              "the right.",
          .attributes = {{.name = "name", .help = "by which errors call it"},
                         {.name = "path",
                          .type = AttributeType::path,
                          .help = "centre line on the ground; repeated, the pieces follow each other",
                          .unit = "m",
                          .minimum = -1e6,
                          .maximum = 1e6,
                          .is_required = true,
                          .is_repeatable = true},
                         {.name = "lanes",
                          .type = AttributeType::integer,
                          .help = "in each direction",
                          .fallback = "1",
                          .minimum = 1,
                          .maximum = 8},
                         {.name = "one_way",
                          .type = AttributeType::flag,
                          .help = "all lanes run from the first point to the last",
                          .fallback = "0"},
                         {.name = "lane_width",
                          .type = AttributeType::number,
                          .help = "of one lane",
                          .fallback = "3",
                          .unit = "m",
                          .minimum = 1,
                          .maximum = 20},
                         {.name = "speed_km_h",
                          .type = AttributeType::number,
                          .help = "the limit",
                          .fallback = "50",
                          .unit = "km/h",
                          .minimum = 1,
                          .maximum = 300}},
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
  builder.roads.push_back(std::move(road));
}

/// As the room `traffic` calls its objects.
std::vector<std::string> names_of_vehicles(const Node& node) {
  std::vector<std::string> names;
  for (long i = 1; i <= node.integer("vehicles"); ++i) names.push_back(fmt::format("vehicle {}", i));
  return names;
}

NodeSchema traffic_schema() {
  return {
      .type = "traffic",
      .help =
          "Vehicles on the roads of the scene. Its models are the kinds of vehicles: x forward, y left, "
          "the road "
          "at z = 0 (turn them with heading_deg), wheels as nodes whose names hold \"wheel\". The "
          "vehicles are "
          "called \"vehicle 1\", \"vehicle 2\", ...: cameras can follow them.",
      .attributes = {{.name = "name", .help = "by which other nodes refer to it; %traffic does, too"},
                     {.name = "vehicles",
                      .type = AttributeType::integer,
                      .help = "how many",
                      .minimum = 0,
                      .maximum = 10'000,
                      .is_required = true},
                     {.name = "seed",
                      .type = AttributeType::integer,
                      .help = "the same seed gives the same traffic",
                      .fallback = "1",
                      .minimum = 0},
                     {.name = "centre",
                      .type = AttributeType::vec3,
                      .help = "of the part of the town that they keep to",
                      .fallback = "0 0 0",
                      .unit = "m"},
                     {.name = "radius",
                      .type = AttributeType::number,
                      .help =
                          "of that part: they start in it, and turn back at its rim where streets let them",
                      .fallback = "1000000",
                      .unit = "m",
                      .minimum = 10,
                      .maximum = 1e6},
                     visible_attribute()},
      .example =
          "traffic(vehicles=30, seed=7, centre=\"40 -20 0\", radius=250) {\n"
          "  model(file=\"cars/van.glb\", heading_deg=-90)\n"
          "}",
      .is_unique = true,
      .is_laid_out_once = true,
      .names_made = names_of_vehicles};
}

void build_traffic(const Node& node, SceneBuilder& builder) {
  TrafficDemand& traffic = builder.scene.traffic;
  traffic.is_visible = builder.is_visible() && node.flag("visible");
  if (!traffic.models.empty()) return;  // built again
  traffic.vehicles = int(node.integer("vehicles"));
  traffic.seed = std::uint64_t(node.integer("seed"));
  traffic.centre = glm::vec2(node.vec3("centre"));
  traffic.radius_m = float(node.number("radius"));
  for (const Node& kind : node.children) {
    const std::shared_ptr<const Model> model = model_of(kind, builder);
    if (!model) continue;
    const glm::quat turn = glm::angleAxis(-kind.angle("heading_deg"), glm::vec3(0.0f, 0.0f, 1.0f));
    traffic.models.push_back(std::make_shared<const Model>(
        placed(*model, kind.vec3("position"), turn, float(kind.number("scale")))));
  }
}

NodeSchema streets_schema() {
  return {
      .type = "streets",
      .help =
          "Roads of a model: the centre lines that its file gives (OpenStreetMap), else along the middle of "
          "its road surfaces: of the parts that match target, those whose names do not speak of footpaths, "
          "cycle paths, parking or rails. Stands after the model.",
      .attributes = {{.name = "of", .help = "name of the model", .is_required = true},
                     {.name = "target",
                      .help =
                          "name of objects, nodes or materials of the file; * and ? stand for any text and "
                          "any character",
                      .fallback = "*Road*",
                      .is_repeatable = true},
                     {.name = "speed_km_h",
                      .type = AttributeType::number,
                      .help = "the limit where the file gives none",
                      .fallback = "30",
                      .unit = "km/h",
                      .minimum = 1,
                      .maximum = 300}},
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
    builder.roads.push_back(std::move(road));
  }
}

void build_streets(const Node& node, SceneBuilder& builder) {
  const std::string name = node.text("of");
  const auto object = std::ranges::find(builder.scene.objects, name, &Object::name);
  if (object == builder.scene.objects.end())
    return builder.fail(
        error_at(node.where_of("of"), "no model called \"{}\" stands before this node", name));
  if (!object->model->roads.empty()) return add_given_roads(*object, builder);

  std::vector<RoadPolygon> polygons;
  if (!node.gives("target")) add_road_polygons(*object, node.text("target"), polygons);
  for (const NodeAttribute& attribute : node.attributes)
    if (attribute.schema->name == "target") add_road_polygons(*object, attribute.text, polygons);
  const std::vector<Road> roads = roads_from_polygons(polygons);
  if (roads.empty())
    builder.warn(error_at(node.where_of("of"), "streets: \"{}\" has no road surfaces that match", name));
  for (Road road : roads) {
    road.speed_limit = float(node.number("speed_km_h")) * m_s_per_km_h;
    road.where = node.where_of("of");
    builder.roads.push_back(std::move(road));
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

void build_paving(const Node&, SceneBuilder& builder) { builder.has_paving = true; }

}  // namespace

void add_road_nodes(NodeRegistry& registry) {
  registry.add(road_schema(), build_road);
  registry.add(streets_schema(), build_streets);
  registry.add(paving_schema(), build_paving);
  registry.add(traffic_schema(), build_traffic);
}

}  // namespace parvis::scene
