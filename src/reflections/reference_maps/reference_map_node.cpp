#include "reflections/reference_maps/reference_map_node.h"

#include "reflections/reference_maps/settings.h"
#include "scene/data/path.h"
#include "scene/script/attribute.h"
#include "scene/script/scene_builder.h"

namespace parvis::reference_maps {
namespace {

constexpr std::size_t max_places = 20000;

scene::NodeSchema reference_maps_schema() {
  using namespace scene::attribute;
  return {
      .type = "referenceMaps",
      .help =
          "The maps that reflection methods with reference maps look into. Without places "
          "they stand along the streets, where they show most of what vehicles mirror.",
      .attributes =
          {points("position", "where a map is taken, at the height of bodywork; may be repeated")
               .in("m")
               .between(-1e6, 1e6)
               .repeatable(),
           path("path", "a line along which maps are taken, `spacing` apart").in("m").between(-1e6, 1e6),
           number("spacing", "of the maps along `path`").in("m").between(0.5, 1e5).by_default("20"),
           integer("maps", "how many place themselves, at most; absent: as reflection has it")
               .between(1, double(max_places)),
           integer("resolution", "edge of a cube map's face that is as sharp; absent: as reflection has it")
               .in("pixels")
               .between(8, 2048),
           number("cell",
                  "of the heights in which mirrored rays are traced; places that would take more than 256 MB "
                  "get larger ones, with a warning")
               .in("m")
               .between(0.05, 100)
               .by_default("1"),
           number("memory",
                  "for the maps that a method with a working set holds at once; of more maps those are held "
                  "that "
                  "were looked into last")
               .in("MB")
               .between(1, 65536)
               .by_default("1024"),
           flag("compressed", "colours take a quarter of the graphics memory, a little less true")
               .by_default("0")},
      .example = "referenceMaps(position=\"0 -20 1.2\", position=\"0 20 1.2\", compressed=yes)",
      .is_unique = true,
      .is_laid_out_once = true};
}

void build_reference_maps(const scene::Node& node, scene::SceneBuilder& builder) {
  ReferenceMapPlan& plan = map_plan(builder.scene);
  std::vector<glm::vec3> places = node.points("position");
  if (node.gives("path")) {
    const scene::MeasuredPath path(node.points("path"));
    const float spacing_m = float(node.number("spacing"));
    const std::size_t count = std::size_t(path.length() / spacing_m) + 1;
    for (std::size_t i = 0; i < std::min(count, max_places + 1); ++i)
      places.push_back(path.at(float(i) * spacing_m));
  }
  if (places.size() > max_places) {
    builder.fail(error_at(node.where, "more than {} reference maps; take a wider spacing", max_places));
    return;
  }
  for (const glm::vec3& place : places)
    plan.places.emplace_back(builder.world_from_parent() * glm::vec4(place, 1.0f));
  if (node.gives("maps")) plan.max_maps = int(node.integer("maps"));
  if (node.gives("resolution")) plan.resolution = int(node.integer("resolution"));
  plan.cell_m = float(node.number("cell"));
  plan.memory_mb = float(node.number("memory"));
  plan.is_compressed = node.flag("compressed");
}

}  // namespace

void add_reference_map_node(scene::NodeRegistry& registry) {
  registry.add(reference_maps_schema(), build_reference_maps);
}

}  // namespace parvis::reference_maps
