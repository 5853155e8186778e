#include <algorithm>

#include "base/registries.h"
#include "room_list.h"
#include "scene/action/actions.h"
#include "scene/action/animation_process.h"
#include "scene/action/key_names.h"
#include "scene/script/attribute.h"
#include "scene/script/scene_builder.h"

namespace parvis::action {
namespace {

using namespace scene::attribute;

using scene::AttributeSchema, scene::AttributeType, scene::MessageSchema, scene::NodeSchema;

// These nodes build nothing: Actions reads them when the scene runs. What no schema can say is checked here.

void build_nothing(const scene::Node&, scene::SceneBuilder&) {}

void check_times(const scene::Node& node, const char* parts, scene::SceneBuilder& builder) {
  if (node.children.empty())
    return builder.fail(error_at(node.where, "the {} has no {}; give it some", node.schema->type, parts));
  for (auto before = node.children.begin(), part = std::next(before); part != node.children.end();
       before = part++)
    if (part->number("time_s") <= before->number("time_s"))
      builder.fail(error_at(part->where_of("time_s"), "time_s={} is not later than the {} before",
                            part->number("time_s"), part->schema->type));
}

void check_path(const scene::Node& node, scene::SceneBuilder& builder) {
  check_times(node, "keys", builder);
  for (const char* angle : {"heading_deg", "pitch_deg"}) {
    const auto gives = [&](const scene::Node& key) { return key.gives(angle); };
    const auto count = std::count_if(node.children.begin(), node.children.end(), gives);
    if (count != 0 && count != std::ptrdiff_t(node.children.size()))
      builder.fail(error_at(std::find_if_not(node.children.begin(), node.children.end(), gives)->where,
                            "this key gives no {}=, others of the path do; give it on all or on none",
                            angle));
  }
  for (const scene::NodeAttribute& attribute : node.attributes)
    if (const auto* event = std::get_if<scene::Event>(&attribute.value);
        event && std::strtod(event->source.c_str(), nullptr) > double(node.children.size()))
      builder.fail(error_at(attribute.where, "onPass: the path has no key {}; it has {}", event->source,
                            node.children.size()));
}

void check_tour(const scene::Node& node, scene::SceneBuilder& builder) {
  check_times(node, "stops", builder);
}

const AttributeSchema name_attribute = text("name", "by which other nodes refer to it");

AttributeSchema event(const char* of, const char* help, AttributeType source,
                      std::vector<std::string> choices = {}) {
  std::string lower = of;
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = char(c + 'a' - 'A');
  AttributeSchema schema = of_type(AttributeType::event, of, help);
  schema.source = source;
  return std::move(schema).or_one_of(std::move(choices)).spelled({lower}).repeatable();
}

/// The attribute `running` of nodes that run in time.
AttributeSchema running(const char* fallback) {
  return flag("running", "it runs when the scene begins").by_default(fallback).live();
}

const std::vector<MessageSchema> running_messages{{"start", "runs from the beginning", {}},
                                                  {"stop", "halts where it is", {}},
                                                  {"resume", "goes on from where it halted", {}}};

const AttributeSchema time_attribute = number("time_s", "when, from the beginning; later than the one before")
                                           .in("s")
                                           .between(0, 1e6)
                                           .required();

NodeSchema keys_schema() {
  return {.type = "keys",
          .help =
              "Messages sent when a person presses or releases a key or a button. The window's own use of "
              "such a key "
              "rests.",
          .attributes = {name_attribute,
                         event("onPress", "sent when it goes down", AttributeType::choice, key_names()),
                         event("onRelease", "sent when it comes up", AttributeType::choice, key_names())},
          .example =
              "group(name=\"trees\") {\n"
              "  group(name=\"oaks\", visible=0) { }\n"
              "}\n"
              "keys(onPress=\"button2, trees, show oaks, 0.5\", onPress=\"h, trees, hide oaks\")"};
}

NodeSchema timer_schema() {
  return {
      .type = "timer",
      .help = "Messages sent at times.",
      .attributes =
          {name_attribute, running("1"),
           number("period_s", "after which it starts over; 0: never").in("s").between(0, 1e6).by_default("0"),
           event("onTime", "sent so many seconds after the timer began", AttributeType::number)},
      .example =
          "group(name=\"lamps\", visible=0) { }\n"
          "timer(period_s=20, onTime=\"5, lamps, show\", onTime=\"15, lamps, hide\")",
      .messages = running_messages};
}

NodeSchema proximity_schema() {
  return {
      .type = "proximity",
      .help = "Messages sent when the visitor or an object comes near a point, or leaves.",
      .attributes = {name_attribute, vec3("position", "of the point").in("m").by_default("0 0 0").live(),
                     number("radius_m", "what counts as near").in("m").between(0, 1e6).by_default("5").live(),
                     event("onEnter", "sent when it comes near", AttributeType::reference, {"visitor"}),
                     event("onLeave", "sent when it leaves", AttributeType::reference, {"visitor"})},
      .example =
          "group(name=\"terrace\", visible=0) { }\n"
          "proximity(position=\"12 4 0\", radius_m=8, onEnter=\"visitor, terrace, show\")"};
}

NodeSchema path_schema() {
  return {
      .type = "path",
      .help =
          "Moves an object, a group or a camera through its keys. Objects that move stand in nothing that is "
          "computed once.",
      .attributes =
          {name_attribute,
           reference("of", "the node that moves; its position and heading are those of the path",
                     {"model", "group", "camera"})
               .required(),
           running("1"), flag("loop", "starts over after the last key").by_default("0"),
           flag("smooth", "runs in curves through the keys; else straight").by_default("1"),
           flag("along",
                "looks where it goes: an object's x axis, a camera's view; an object's own heading_deg "
                "counts from there")
               .by_default("0"),
           event("onPass", "sent when it reaches the key of this number", AttributeType::integer)},
      .example =
          "group(name=\"tram\") { }\n"
          "path(of=\"tram\", along=1, loop=1) {\n"
          "  key(time_s=0, position=\"-40 0 0\")\n"
          "  key(time_s=6, position=\"0 4 0\")\n"
          "  key(time_s=12, position=\"40 0 0\")\n"
          "}",
      .messages = running_messages};
}

NodeSchema key_schema() {
  return {.type = "key",
          .help = "Where a path is at a time. Without angles on any key, the node keeps its own.",
          .attributes = {time_attribute,
                         vec3("position", "in the frame in which the moving node stands").in("m").required(),
                         angle("heading_deg", "as the moving node's own; on no key or on all").in("degrees"),
                         angle("pitch_deg", "of a camera, upward from the horizon; on no key or on all")
                             .in("degrees")
                             .between(-90, 90)},
          .stands_in = {"path"},
          .example =
              "camera(name=\"crane\")\n"
              "path(of=\"crane\") {\n"
              "  key(time_s=0, position=\"0 0 2\", heading_deg=0, pitch_deg=0)\n"
              "  key(time_s=8, position=\"0 0 30\", heading_deg=90, pitch_deg=-30)\n"
              "}"};
}

NodeSchema tour_schema() {
  return {.type = "tour",
          .help = "The view glides through cameras: what parvis render --tour and parvis view --tour show.",
          .attributes = {text("name", "what --tour takes").required(), running("0"),
                         flag("loop", "starts over after the last stop").by_default("0"),
                         flag("smooth", "runs in curves through the stops; else straight").by_default("1")},
          .example =
              "camera(name=\"street\", position=\"0 -20 1.6\")\n"
              "camera(name=\"balcony\", position=\"8 0 9\", heading_deg=270)\n"
              "tour(name=\"arrival\") {\n"
              "  stop(time_s=0, camera=\"street\")\n"
              "  stop(time_s=10, camera=\"balcony\")\n"
              "}",
          .messages = running_messages};
}

NodeSchema stop_schema() {
  return {.type = "stop",
          .help = "A camera through which a tour goes; one that follows an object is where it is then.",
          .attributes = {time_attribute, reference("camera", "which", {"camera"}).required()},
          .stands_in = {"tour"},
          .example =
              "camera(name=\"street\", position=\"0 -20 1.6\")\n"
              "tour(name=\"stay\") { stop(time_s=0, camera=\"street\") }"};
}

}  // namespace

const std::vector<std::string>& key_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"space", "enter",  "tab",     "backspace", "delete", "insert",
                                 "home",  "end",    "up",      "down",      "left",   "right",
                                 "comma", "period", "page_up", "page_down"};
    for (char c = 'a'; c <= 'z'; ++c) all.emplace_back(1, c);
    for (char c = '0'; c <= '9'; ++c) all.emplace_back(1, c);
    for (int i = 1; i <= 12; ++i) all.push_back(fmt::format("f{}", i));
    for (int i = 1; i <= 8; ++i) all.push_back(fmt::format("mouse{}", i));
    for (int i = 1; i <= 16; ++i) all.push_back(fmt::format("button{}", i));
    return all;
  }();
  return names;
}

/// Adds their processes and the node types keys, timer, proximity; path and tour with their keyframes.
void register_room(Registries& registries) {
  scene::NodeRegistry& registry = registries.get<scene::NodeRegistry>();
  registry.add(keys_schema(), build_nothing);
  registry.add(timer_schema(), build_nothing);
  registry.add(proximity_schema(), build_nothing);
  registry.add(path_schema(), check_path);
  registry.add(key_schema(), build_nothing);
  registry.add(tour_schema(), check_tour);
  registry.add(stop_schema(), build_nothing);
  Processes& processes = registries.get<Processes>();
  processes.add([] { return std::make_unique<Actions>(); });
  processes.add([] { return std::make_unique<AnimationProcess>(); });
}

}  // namespace parvis::action
