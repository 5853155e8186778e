#include "planning/design/kind.h"

#include <algorithm>
#include <cassert>

#include "base/known_names.h"
#include "planning/design/shape_models.h"
#include "scene/script/attribute.h"
#include "scene/script/scene_builder.h"
#include "scene/script/script_checker.h"

namespace parvis::design {

/// kinds.xp, embedded by CMakeLists.txt.
extern const char* const shipped_kinds_text;

namespace {

using namespace scene::attribute;

constexpr std::array<std::pair<const char*, Changeable>, 5> changeables{{{"width", Changeable::width},
                                                                         {"depth", Changeable::depth},
                                                                         {"height", Changeable::height},
                                                                         {"colour", Changeable::colour},
                                                                         {"material", Changeable::material}}};

scene::NodeSchema kind_schema() {
  return {
      .type = "kind",
      .help = "A kind of object that designs may place, beside those that the program has.",
      .attributes = {text("name", "by which placed(kind=...) and commands call it").required(),
                     text("label", "what people call it"), text("label_fr", "the same in French"),
                     choice("tab", "of the catalogue", {"seats", "shade", "green", "street", "people", "own"})
                         .by_default("own"),
                     file("file", "a model, with its foot at the origin and its front towards -y"),
                     choice("shape", "that is generated, in place of a file", shape_names()),
                     text("plant", "a kind of plant that grows on it, or in place of a file"),
                     choice("person", "who stands there, each another one, in place of a file",
                            {"stand", "wait", "talk", "phone"}),
                     number("age", "of the person, in years; without it: grown up").between(4, 95),
                     vec3("size", "width along the front, depth and height").in("m").required(),
                     vec3("min", "the least of these").in("m").by_default("0.01 0.01 0.01"),
                     vec3("max", "the most of these").in("m").by_default("100 100 100"),
                     text("changes", "what may be changed: width, depth, height, colour, material"),
                     colour("colour", "of what may have another one").by_default("#808080"),
                     flag("round", "its plan is an ellipse").by_default("0")},
      .stands_in = {scene::top_level, "group", "design"},
      .example = "kind(name=\"planter_oak\", label=\"Oak planter\", shape=planter, size=\"1 1 0.6\")"};
}

Kind kind_of(const scene::Node& node) {
  Kind kind;
  kind.name = node.text("name");
  kind.label = node.gives("label") ? node.text("label") : kind.name;
  kind.label_fr = node.gives("label_fr") ? node.text("label_fr") : kind.label;
  kind.tab = node.text("tab"), kind.plant = node.text("plant"), kind.file = node.file("file").string();
  if (node.gives("shape")) kind.shape = node.text("shape");
  if (node.gives("person")) kind.person = node.text("person");
  if (node.gives("age")) kind.age = float(node.number("age"));
  kind.size_m = exact_decimals(node.vec3("size")), kind.min_m = exact_decimals(node.vec3("min")),
  kind.max_m = exact_decimals(node.vec3("max"));
  const std::string changes = node.text("changes");
  for (const auto& [name, what] : changeables)
    if (changes.find(name) != std::string::npos) kind.changes.push_back(what);
  kind.colour = node.vec3("colour"), kind.is_round = node.flag("round");
  return kind;
}

}  // namespace

bool Kind::may_change(Changeable what) const { return std::ranges::find(changes, what) != changes.end(); }

const std::vector<Kind>& shipped_kinds() {
  static const std::vector<Kind> kinds = [] {
    scene::NodeRegistry registry;
    add_kind_node(registry);
    const Result<scene::Nodes> nodes =
        scene::check_piece(shipped_kinds_text, "kinds.xp", scene::top_level, {}, registry, Roots(""));
    assert(nodes && "the catalogue is a script");
    std::vector<Kind> made;
    for (const scene::Node& node : *nodes) made.push_back(kind_of(node));
    return made;
  }();
  return kinds;
}

void forget_kind(scene::Scene& scene, const std::string& name) {
  std::erase_if(scene.data<Kinds>().own, [&](const Kind& kind) { return kind.name == name; });
}

std::vector<Kind> kinds_of(const scene::Scene& scene) {
  std::vector<Kind> all = shipped_kinds();
  const std::vector<Kind>& own = scene.data<Kinds>().own;
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

const Kind* find_kind(const scene::Scene& scene, const std::string& name) {
  for (const std::vector<Kind>* kinds : {&scene.data<Kinds>().own, &shipped_kinds()})
    if (const auto kind = std::ranges::find(*kinds, name, &Kind::name); kind != kinds->end()) return &*kind;
  return nullptr;
}

std::string no_such_kind(const scene::Scene& scene, const std::string& name) {
  std::vector<std::string> known;
  for (const Kind& kind : kinds_of(scene)) known.push_back(kind.name);
  return fmt::format("the catalogue has no kind \"{}\"{}", name.substr(0, 40), names_that_exist(name, known));
}

void add_kind_node(scene::NodeRegistry& registry) {
  registry.add(kind_schema(), [](const scene::Node& node, scene::SceneBuilder& builder) {
    const Kind kind = kind_of(node);
    if (kind.file.empty() && kind.shape.empty() && kind.plant.empty() && kind.person.empty())
      return builder.fail(error_at(
          node.where, "kind \"{}\" has nothing to show; give file=, shape=, plant= or person=", kind.name));
    std::vector<Kind>& own = builder.scene.data<Kinds>().own;
    if (const auto known = std::ranges::find(own, kind.name, &Kind::name); known != own.end())
      *known = kind;
    else
      own.push_back(kind);
  });
}

}  // namespace parvis::design
