#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/registries.h"
#include "graphics/lit_objects/lighting_process.h"
#include "room_list.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/scene_builder.h"

namespace parvis::lit_objects {
namespace {

scene::NodeSchema lit_virtual_object_schema() {
  using namespace scene::attribute;
  return {
      .type = lit_type,
      .help =
          "Objects whose diffuse light is found at their vertices: of the sky and the sun with what hides "
          "them, "
          "by rays, when the scene is loaded and again when an object moves or the sky changes; first "
          "quickly, "
          "then better from frame to frame.",
      .attributes =
          {integer("rays", "to the sky from each vertex, in the end")
               .between(16, 4096)
               .by_default("256")
               .live(),
           number(
               "budget_ms",
               "about how long lighting may take in a frame after a change, as this program's rays take on "
               "two "
               "cores: what has no time for rays keeps its light until its turn comes; 0: however long it "
               "takes")
               .in("ms")
               .between(0.0, 10'000.0)
               .by_default("30")
               .live()},
      .stands_in = {scene::top_level, "group", "scenario"},
      .example =
          "dayLight(timeOfDay=16)\n"
          "litVirtualObject() {\n"
          "  object(file=\"duck.glb\", grab=1, wall=0)\n"
          "  model(file=\"bench.glb\", position=\"3 0 0\", dynamic=1)\n"
          "}"};
}

/// Nodes of rooms that draw by themselves, whose vertices get no light of their own: groups may hold them.
constexpr std::array<std::string_view, 4> drawn_otherwise{"plant", "tree", "facade", "vdobject"};

void find_drawn_otherwise(const scene::Nodes& nodes, std::vector<const scene::Node*>& found) {
  for (const scene::Node& node : nodes) {
    if (std::ranges::find(drawn_otherwise, node.schema->type) != drawn_otherwise.end())
      found.push_back(&node);
    find_drawn_otherwise(node.children, found);
  }
}

void build_lit(const scene::Node& node, scene::SceneBuilder& builder) {
  builder.build(node.children);
  std::vector<const scene::Node*> others;
  find_drawn_otherwise(node.children, others);
  if (others.empty()) return;
  const std::string more =
      others.size() > 1 ? fmt::format(", with {} more of the kind,", others.size() - 1) : "";
  builder.warn(error_at(others.front()->where,
                        "{} lights the vertices of objects and models alone: this {}{} stays in the light of "
                        "the scene, which plants, trees and photographs have; put it outside of {}",
                        lit_type, others.front()->schema->type, more, lit_type));
}

}  // namespace

/// Adds the node litVirtualObject and the process that lights what stands in it. After the rooms whose nodes
/// stand in it, and whose processes move things.
void register_room(Registries& registries) {
  scene::NodeRegistry& registry = registries.get<scene::NodeRegistry>();
  registry.add(lit_virtual_object_schema(), build_lit);
  for (const char* const child : {"object", "model", "group", "include"}) registry.allow(child, lit_type);
  registries.get<action::Processes>().add([] { return std::make_unique<LightingProcess>(); });
}

}  // namespace parvis::lit_objects
