// road, paving, traffic: where vehicles drive, and which.
#include "scene/model_assembly.h"
#include "scene/model_node.h"
#include "scene/node_registry.h"
#include "scene/nodes.h"
#include "scene/placement.h"
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
          .example = "road(path=\"0 0, 120 0, 200 40\", lanes=2, speed_km_h=30)"};
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
  return {.type = "traffic",
          .help =
              "Vehicles on the roads of the scene. Its models are the kinds of vehicles: x forward, y left, "
              "the road "
              "at z = 0 (turn them with heading_deg), wheels as nodes whose names hold \"wheel\". The "
              "vehicles are "
              "called \"vehicle 1\", \"vehicle 2\", ...: cameras can follow them.",
          .attributes = {{.name = "vehicles",
                          .type = AttributeType::integer,
                          .help = "how many",
                          .minimum = 0,
                          .maximum = 10'000,
                          .is_required = true},
                         {.name = "seed",
                          .type = AttributeType::integer,
                          .help = "the same seed gives the same traffic",
                          .fallback = "1",
                          .minimum = 0}},
          .example =
              "traffic(vehicles=30, seed=7) {\n"
              "  model(file=\"cars/van.glb\", heading_deg=-90)\n"
              "}",
          .is_unique = true,
          .names_made = names_of_vehicles};
}

void build_traffic(const Node& node, SceneBuilder& builder) {
  TrafficDemand& traffic = builder.scene.traffic;
  traffic.vehicles = int(node.integer("vehicles"));
  traffic.seed = std::uint64_t(node.integer("seed"));
  for (const Node& kind : node.children) {
    const std::shared_ptr<const Model> model = model_of(kind, builder);
    if (!model) continue;
    const glm::quat turn = glm::angleAxis(-kind.angle("heading_deg"), glm::vec3(0.0f, 0.0f, 1.0f));
    traffic.models.push_back(std::make_shared<const Model>(
        placed(*model, kind.vec3("position"), turn, float(kind.number("scale")))));
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
          .is_unique = true};
}

void build_paving(const Node&, SceneBuilder& builder) { builder.has_paving = true; }

}  // namespace

void add_road_nodes(NodeRegistry& registry) {
  registry.add(road_schema(), build_road);
  registry.add(paving_schema(), build_paving);
  registry.add(traffic_schema(), build_traffic);
}

}  // namespace parvis::scene
