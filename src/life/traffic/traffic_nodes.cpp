#include "base/registries.h"
#include "formats/meshes/model_assembly.h"
#include "formats/meshes/model_node.h"
#include "life/traffic/demand.h"
#include "life/traffic/signal_masts.h"
#include "life/traffic/traffic_process.h"
#include "room_list.h"
#include "scene/script/attribute.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"

namespace parvis::traffic {
namespace {

using namespace scene::attribute;

using scene::Node, scene::SceneBuilder;

std::vector<std::string> vehicle_names(const Node& node) {
  std::vector<std::string> names;
  for (long i = 1; i <= node.integer("vehicles"); ++i) names.push_back(vehicle_name(std::size_t(i - 1)));
  return names;
}

scene::NodeSchema traffic_schema() {
  return {
      .type = "traffic",
      .help =
          "Vehicles on the roads of the scene. Its models are the kinds of vehicles: x forward, y left, "
          "the road "
          "at z = 0 (turn them with heading_deg), wheels as nodes whose names hold \"wheel\". The "
          "vehicles are "
          "called \"vehicle 1\", \"vehicle 2\", ...: cameras can follow them.",
      .attributes = {text("name", "by which other nodes refer to it; %traffic does, too"),
                     integer("vehicles", "how many").between(0, 10'000).required(),
                     integer("seed", "the same seed gives the same traffic").from(0).by_default("1"),
                     vec3("centre", "of the part of the town that they keep to").in("m").by_default("0 0 0"),
                     number("radius",
                            "of that part: they start in it, and turn back at its rim where streets let them")
                         .in("m")
                         .between(10, 1e6)
                         .by_default("1000000"),
                     scene::visible_attribute()},
      .example =
          "traffic(vehicles=30, seed=7, centre=\"40 -20 0\", radius=250) {\n"
          "  model(file=\"cars/van.glb\", heading_deg=-90)\n"
          "}",
      .is_unique = true,
      .is_laid_out_once = true,
      .names_made = vehicle_names};
}

/// The model of a `model` node inside the traffic, turned as the node says; null, with the errors in
/// `builder`, where its file cannot be used.
std::shared_ptr<const scene::Model> vehicle_model(const Node& kind, SceneBuilder& builder,
                                                  const formats::Readers& readers) {
  const std::shared_ptr<const scene::Model> model = scene::model_of(kind, builder, readers);
  if (!model) return nullptr;
  return builder.shared_model("vehicle " + signature(kind), [&] {
    const glm::quat turn = glm::angleAxis(-kind.angle("heading_deg"), glm::vec3(0.0f, 0.0f, 1.0f));
    return std::make_shared<const scene::Model>(
        scene::placed(*model, kind.vec3("position"), turn, float(kind.number("scale"))));
  });
}

void build_traffic(const Node& node, SceneBuilder& builder, const formats::Readers& readers) {
  TrafficDemand demand;
  demand.vehicles = int(node.integer("vehicles"));
  demand.seed = std::uint64_t(node.integer("seed"));
  demand.is_visible = builder.is_visible() && node.flag("visible");
  for (const Node& kind : node.children)
    if (auto model = vehicle_model(kind, builder, readers)) demand.models.push_back(std::move(model));
  builder.scene.data<TrafficDemand>() = std::move(demand);
  builder.scene.data<scene::DrivingArea>() = {glm::vec2(node.vec3("centre")), float(node.number("radius"))};
}

scene::NodeSchema lights_schema() {
  return {.type = "trafficLights",
          .help =
              "Traffic lights at a junction of the scene's roads: streets that face each other have green "
              "together, people cross the others meanwhile, and trams are let through. Masts stand at the "
              "stop lines and beside the crossings.",
          .attributes = {text("name", "of the lights"),
                         vec3("position", "in the middle of the junction, within 30 m").in("m").required(),
                         number("green_s", "of each phase, at least: longer where people need it to cross")
                             .in("s")
                             .between(5, 180)
                             .by_default("20"),
                         number("offset_s", "how long the first phase has run when the scene begins")
                             .in("s")
                             .between(0, 600)
                             .by_default("0"),
                         number("beside",
                                "of the masts from the edge of the outer lane: beyond parking "
                                "strips, on the pavement")
                             .in("m")
                             .between(0.2, 10)
                             .by_default("0.9"),
                         scene::visible_attribute()},
          .example =
              "road(path=\"-80 0, 80 0\")\nroad(path=\"0 -80, 0 80\")\n"
              "trafficLights(position=\"0 0 0\", green_s=25)",
          .is_laid_out_once = true};
}

void build_lights(const Node& node, SceneBuilder& builder) {
  SignalDemand demand;
  demand.called = node.gives("name") ? node.text("name") : "traffic lights";
  demand.position = glm::vec3(builder.world_from_parent() * glm::vec4(node.vec3("position"), 1.0f));
  demand.green_s = float(node.number("green_s")), demand.offset_s = float(node.number("offset_s"));
  demand.beside_m = float(node.number("beside"));
  demand.is_visible = builder.is_visible() && node.flag("visible");
  demand.where = node.where_of("position");
  builder.add(std::move(demand));
}

/// Lays out all lights once the lanes are there, and sets up their masts.
void finish_lights(SceneBuilder& builder) {
  const scene::ItemsOf<SignalDemand> demands = builder.scene.data<scene::ItemsOf<SignalDemand>>();
  if (demands.items.empty() || !builder.errors().empty()) return;
  const std::vector<scene::StreetCrossing> crossings = scene::street_crossings(builder.scene);
  std::vector<int> lit;
  for (std::size_t i = 0; i < demands.items.size(); ++i) {
    const SignalDemand& demand = demands.items[i];
    const Result<SignalJunction> junction = signals_at(builder.scene.roads, crossings, demand);
    if (!junction) {
      builder.fail(junction.errors(), demand.where);
      continue;
    }
    if (std::ranges::count(lit, junction->junction) > 0) {
      builder.fail(error_at(demand.where,
                            "trafficLights: the nearest junction, at {:.1f} {:.1f}, has lights "
                            "already; leave out one of both",
                            junction->middle.x, junction->middle.y));
      continue;
    }
    lit.push_back(junction->junction);
    scene::Object masts;
    masts.name = demand.called + " masts";
    masts.model = signal_masts(*junction), masts.is_visible = demand.is_visible;
    builder.add_for(demands.makers[i], {std::move(masts)});
  }
}

}  // namespace

/// Adds the node types and the process.
void register_room(Registries& registries) {
  scene::NodeRegistry& registry = registries.get<scene::NodeRegistry>();
  const formats::Readers& readers = registries.get<formats::Readers>();
  registry.add(traffic_schema(), [&readers](const Node& node, SceneBuilder& builder) {
    build_traffic(node, builder, readers);
  });
  registries.get<action::Processes>().add([] { return std::make_unique<TrafficProcess>(); });
  registry.add(lights_schema(), build_lights);
  registry.add_finish_step(finish_lights);
  registry.allow("model", "traffic");
  registry.allow(scene::include_type, "traffic");
}

}  // namespace parvis::traffic
