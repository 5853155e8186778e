#include "base/known_names.h"
#include "base/registries.h"
#include "formats/meshes/model_assembly.h"
#include "formats/meshes/model_node.h"
#include "land/roads/places_on_map.h"
#include "life/traffic/bus_stops.h"
#include "life/traffic/demand.h"
#include "life/traffic/signal_masts.h"
#include "life/traffic/traffic_process.h"
#include "room_list.h"
#include "scene/data/object_names.h"
#include "scene/script/attribute.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"

namespace parvis::traffic {
namespace {

using namespace scene::attribute;

using scene::Node, scene::SceneBuilder;

std::vector<std::string> vehicle_names(const Node& node) {
  std::vector<std::string> names;
  for (long i = 1; i <= node.integer("vehicles") + node.integer("bicycles"); ++i)
    names.push_back(vehicle_name(std::size_t(i - 1)));
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
                     integer("bicycles",
                             "how many people ride bicycles, which need no model; they are called as "
                             "vehicles are, behind these")
                         .between(0, 1000)
                         .by_default("0"),
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
  demand.bicycles = int(node.integer("bicycles"));
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
                         vec3("position", "in the middle of the junction, within 30 m").in("m"),
                         text("of",
                              "in place of position, the name of a model: lights at all junctions at which "
                              "its map (OpenStreetMap) has some. Stands after the model"),
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

/// Places of things of the map of the model that `of` names; nothing, with the message, where there are none.
std::vector<glm::vec3> places_on_map_of(const Node& node, std::string_view thing, SceneBuilder& builder) {
  const std::string name = node.text("of");
  const auto object = std::ranges::find(builder.scene.objects, name, &scene::Object::name);
  if (object == builder.scene.objects.end()) {
    builder.fail(error_at(node.where_of("of"), "no model called \"{}\" stands before this node{}", name,
                          names_that_exist(name, scene::object_names(builder.scene))));
    return {};
  }
  std::vector<glm::vec3> places = scene::places_on_map(*object, thing);
  if (places.empty())
    builder.warn(error_at(node.where_of("of"),
                          "{}: the file of \"{}\" has no {} on its streets; position= sets one up",
                          node.schema->type, name, thing));
  return places;
}

/// True, with the message, where not exactly one of position and of is given.
bool is_nowhere(const Node& node, SceneBuilder& builder) {
  if (node.gives("position") != node.gives("of")) return false;
  builder.fail(error_at(node.where,
                        "{} needs either position=, or of=, the name of a model whose map has some",
                        node.schema->type));
  return true;
}

void build_lights(const Node& node, SceneBuilder& builder) {
  SignalDemand demand;
  demand.called = node.gives("name") ? node.text("name") : "traffic lights";
  demand.green_s = float(node.number("green_s")), demand.offset_s = float(node.number("offset_s"));
  demand.beside_m = float(node.number("beside"));
  demand.is_visible = builder.is_visible() && node.flag("visible");
  if (is_nowhere(node, builder)) return;
  demand.where = node.where_of(node.gives("of") ? "of" : "position");
  if (node.gives("of")) {
    demand.is_of_map = true;
    for (const glm::vec3 place : places_on_map_of(node, scene::map_signal_node, builder)) {
      demand.position = place;
      builder.add(SignalDemand(demand));
    }
    return;
  }
  demand.position = glm::vec3(builder.world_from_parent() * glm::vec4(node.vec3("position"), 1.0f));
  builder.add(std::move(demand));
}

/// Things of a map that stand where none can be, by the node that asks for the map's.
class LeftOut {
 public:
  void add(const FileLocation& where, glm::vec3 position) {
    const auto known = std::ranges::find_if(places_, [&](const Places& it) {
      return it.where.file == where.file && it.where.line == where.line && it.where.column == where.column;
    });
    Places& places = known != places_.end() ? *known : places_.emplace_back(Places{where, position, 0});
    ++places.count;
  }
  /// A warning for each node: how many, why, and where the first one is.
  void report(std::string_view node, std::string_view why, SceneBuilder& builder) const {
    for (const Places& it : places_)
      builder.warn(error_at(it.where, "{}: {} of the map are left out, which {}; the first at {:.1f} {:.1f}",
                            node, it.count, why, it.first.x, it.first.y));
  }

 private:
  struct Places {
    FileLocation where;
    glm::vec3 first{0.0f};
    int count = 0;
  };
  std::vector<Places> places_;
};

/// Lays out all lights once the lanes are there, and sets up their masts.
void finish_lights(SceneBuilder& builder) {
  const scene::ItemsOf<SignalDemand> demands = builder.scene.data<scene::ItemsOf<SignalDemand>>();
  if (demands.items.empty() || !builder.errors().empty()) return;
  const std::vector<scene::StreetCrossing> crossings = scene::street_crossings(builder.scene);
  std::vector<int> lit;
  LeftOut left_out;
  for (std::size_t i = 0; i < demands.items.size(); ++i) {
    const SignalDemand& demand = demands.items[i];
    const Result<SignalJunction> junction = signals_at(builder.scene.roads, crossings, demand);
    if (!junction && demand.is_of_map) {  // before a crossing between junctions, say
      left_out.add(demand.where, demand.position);
      continue;
    }
    if (!junction) {
      builder.fail(junction.errors(), demand.where);
      continue;
    }
    if (std::ranges::count(lit, junction->junction) > 0) {
      if (demand.is_of_map) continue;  // maps have one for each approach
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
  left_out.report("trafficLights", "stand at no junction of three streets within 30 m", builder);
}

scene::NodeSchema bus_stop_schema() {
  return {
      .type = "busStop",
      .help =
          "A bus stop beside a street: buses of the traffic (vehicles whose models are called so, or longer "
          "than 8 m) halt at it, and people of a crowd wait, board and alight.",
      .attributes = {vec3("position",
                          "of its pole on the pavement, beside the lane, where the front of a bus halts")
                         .in("m"),
                     text("of",
                          "in place of position, the name of a model: all stops on streets that its map "
                          "(OpenStreetMap) has. Stands after the model"),
                     number("dwell_s", "how long doors are open, at least: longer while people board")
                         .in("s")
                         .between(3, 120)
                         .by_default("12"),
                     scene::visible_attribute()},
      .example = "road(path=\"-80 0, 80 0\")\nbusStop(position=\"10 -4.5 0\")",
      .is_laid_out_once = true};
}

void build_bus_stop(const Node& node, SceneBuilder& builder) {
  if (is_nowhere(node, builder)) return;
  BusStopDemand demand;
  demand.dwell_s = float(node.number("dwell_s"));
  demand.is_visible = builder.is_visible() && node.flag("visible");
  demand.where = node.where_of(node.gives("of") ? "of" : "position");
  demand.is_of_map = node.gives("of");
  if (node.gives("position"))
    demand.position = glm::vec3(builder.world_from_parent() * glm::vec4(node.vec3("position"), 1.0f));
  for (const glm::vec3 place : demand.is_of_map ? places_on_map_of(node, scene::map_bus_stop_node, builder)
                                                : std::vector<glm::vec3>{demand.position}) {
    demand.position = place;
    builder.add(BusStopDemand(demand));
  }
}

/// Sets up the poles once the lanes are there.
void finish_bus_stops(SceneBuilder& builder) {
  const scene::ItemsOf<BusStopDemand> demands = builder.scene.data<scene::ItemsOf<BusStopDemand>>();
  if (demands.items.empty() || !builder.errors().empty()) return;
  LeftOut left_out;
  for (std::size_t i = 0; i < demands.items.size(); ++i) {
    const BusStopDemand& demand = demands.items[i];
    const std::optional<glm::vec2> kerbward = kerbward_of(builder.scene.roads, demand.position);
    if (!kerbward && demand.is_of_map) {
      left_out.add(demand.where, demand.position);
      continue;
    }
    if (!kerbward) {
      builder.fail(error_at(demand.where,
                            "busStop: no lane leads past {:.1f} {:.1f} at its left within 8 m; place it "
                            "on the pavement at the right side of a street",
                            demand.position.x, demand.position.y));
      continue;
    }
    scene::Object pole;
    pole.name = "bus stop", pole.is_visible = demand.is_visible;
    pole.model = bus_stop_pole(demand.position, *kerbward);
    builder.add_for(demands.makers[i], {std::move(pole)});
  }
  left_out.report("busStop", "have no lane at their left within 8 m", builder);
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
  registry.add(bus_stop_schema(), build_bus_stop);
  registry.add_finish_step(finish_bus_stops);
  registry.allow("model", "traffic");
  registry.allow(scene::include_type, "traffic");
}

}  // namespace parvis::traffic
