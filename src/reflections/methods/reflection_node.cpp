// The node `reflection`: the attributes that all methods have in common, then those of each.
#include "reflections/methods/registry.h"
#include "scene/script/attribute.h"
#include "scene/script/scene_builder.h"

namespace parvis::methods {
namespace {

using scene::AttributeSchema, scene::AttributeType;

/// Which method a scene has that names none.
std::string automatic_help(const Registry& registry) {
  std::string help = "how reflections are made; automatic: ";
  for (const Method& method : registry.all())
    if (method.suits) help += fmt::format("{} {}, ", method.name, method.suits_where);
  return help + registry.name_of(scene::Scene()) + " elsewhere";
}

std::vector<AttributeSchema> common_attributes(const Registry& registry) {
  using namespace scene::attribute;
  std::vector<std::string> methods = registry.names();
  methods.insert(methods.begin(), automatic);
  return {
      choice("method", automatic_help(registry), std::move(methods)).by_default(automatic).live(),
      integer("resolution", "edge of one face of a cube map")
          .in("pixels")
          .between(8, 4096)
          .by_default("128")
          .live(),
      flag("level_of_detail", "resolution by size on screen; far objects share one map")
          .by_default("1")
          .live(),
      number("budget_ms",
             "the time of a frame that is held: the two methods with environment_maps make less of small "
             "reflections, and windows draw fewer pixels, enlarged, where that is not enough; pictures and "
             "films go by what reflections are known to cost and keep their pixels; 0: none")
          .in("ms")
          .between(0, 1000)
          .by_default("0")
          .live(),
      integer("bounces",
              "of methods that draw virtual objects and of the ray tracer: 2, what a mirror shows in a "
              "mirror is drawn, too; "
              "1: mirrors in mirrors show the sky")
          .between(1, 2)
          .by_default("1")
          .live()};
}

scene::NodeSchema schema_of(const Registry& registry) {
  scene::NodeSchema schema{.type = "reflection",
                           .help = "How the mirror-like parts of moving things see their surroundings.",
                           .attributes = common_attributes(registry),
                           .example = "reflection(method=\"automatic\", resolution=128)",
                           .is_unique = true};
  std::ranges::move(registry.attributes(), std::back_inserter(schema.attributes));
  return schema;
}

}  // namespace

void add_reflection_node(scene::NodeRegistry& nodes, const Registry& registry) {
  nodes.add(schema_of(registry), [&registry](const scene::Node& node, scene::SceneBuilder& builder) {
    Settings& made = settings(builder.scene);
    made.method = node.text("method");
    made.resolution = int(node.integer("resolution"));
    made.uses_level_of_detail = node.flag("level_of_detail");
    made.budget_ms = float(node.number("budget_ms"));
    made.bounces = int(node.integer("bounces"));
    registry.read(node, made);
  });
}

}  // namespace parvis::methods
