#include "reflections/reference_maps/settings.h"

namespace parvis::reference_maps {

scene::AttributeSchema maps_attribute() {
  return {.name = "maps",
          .type = scene::AttributeType::integer,
          .help =
              "reference maps along the streets, of the methods with environment_maps and of "
              "simple_blend",
          .fallback = fmt::format("{}", MapSettings().max_maps),
          .minimum = 1,
          .maximum = 2000,
          .is_live = true};
}

void read_maps(const scene::Node& node, methods::Settings& settings) {
  settings.own.get<MapSettings>().max_maps = int(node.integer("maps"));
}

}  // namespace parvis::reference_maps
