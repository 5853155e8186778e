#include "base/registries.h"
#include "formats/meshes/model_assembly.h"
#include "formats/meshes/model_node.h"
#include "life/traffic/demand.h"
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

}  // namespace

/// Adds the node type and the process.
void register_room(Registries& registries) {
  scene::NodeRegistry& registry = registries.get<scene::NodeRegistry>();
  const formats::Readers& readers = registries.get<formats::Readers>();
  registry.add(traffic_schema(), [&readers](const Node& node, SceneBuilder& builder) {
    build_traffic(node, builder, readers);
  });
  registries.get<action::Processes>().add([] { return std::make_unique<TrafficProcess>(); });
  registry.allow("model", "traffic");
  registry.allow(scene::include_type, "traffic");
}

}  // namespace parvis::traffic
