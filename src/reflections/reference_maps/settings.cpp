#include "reflections/reference_maps/settings.h"

#include "scene/script/attribute.h"

namespace parvis::reference_maps {

scene::AttributeSchema maps_attribute() {
  return scene::attribute::integer(
             "maps",
             "reference maps along the streets, of the methods with environment_maps and of simple_blend")
      .between(1, 2000)
      .by_default(fmt::format("{}", MapSettings().max_maps))
      .live();
}

void read_maps(const scene::Node& node, methods::Settings& settings) {
  settings.own.get<MapSettings>().max_maps = int(node.integer("maps"));
}

}  // namespace parvis::reference_maps
