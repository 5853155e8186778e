// The node `reflection`: the attributes that all methods have in common, then those of each.
#include "reflections/methods/registry.h"
#include "scene/script/scene_builder.h"

namespace parvis::methods {
namespace {

using scene::AttributeSchema, scene::AttributeType;

std::vector<AttributeSchema> common_attributes(const Registry& registry) {
  return {{.name = "method",
           .type = AttributeType::choice,
           .help = "how reflections are made",
           .fallback = registry.name_of({}),
           .choices = registry.names(),
           .is_live = true},
          {.name = "resolution",
           .type = AttributeType::integer,
           .help = "edge of one face of a cube map",
           .fallback = "128",
           .unit = "pixels",
           .minimum = 8,
           .maximum = 4096,
           .is_live = true},
          {.name = "level_of_detail",
           .type = AttributeType::flag,
           .help = "resolution by size on screen; far objects share one map",
           .fallback = "1",
           .is_live = true},
          {.name = "budget_ms",
           .type = AttributeType::number,
           .help = "the time of a frame that is held: the two methods with environment_maps make "
                   "less of small reflections, and windows draw fewer pixels, enlarged, where that is "
                   "not enough; pictures and films go by what reflections are known to cost and keep "
                   "their pixels; 0: none",
           .fallback = "0",
           .unit = "ms",
           .minimum = 0,
           .maximum = 1000,
           .is_live = true},
          {.name = "bounces",
           .type = AttributeType::integer,
           .help = "of virtual_objects and of the ray tracer: 2, what a mirror shows in a mirror is "
                   "drawn, too; 1: mirrors in mirrors show the sky",
           .fallback = "1",
           .minimum = 1,
           .maximum = 2,
           .is_live = true}};
}

scene::NodeSchema schema_of(const Registry& registry) {
  scene::NodeSchema schema{.type = "reflection",
                           .help = "How the mirror-like parts of moving things see their surroundings.",
                           .attributes = common_attributes(registry),
                           .example = "reflection(method=\"rerendered_cube_map\", resolution=128)",
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
