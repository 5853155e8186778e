#include "reflections/reference_maps/room.h"

#include "reflections/methods/registry.h"
#include "reflections/reference_maps/reference_map_node.h"
#include "reflections/reference_maps/settings.h"
#include "reflections/reference_maps/simple_blend.h"

namespace parvis::reference_maps {

void furnish(House& house) {
  house.get<methods::Registry>().add(
      {.name = "simple_blend",
       .help = "the two nearest reference maps, blended as if they were infinitely far",
       .make = make_simple_blend,
       .attributes = {maps_attribute()},
       .read = read_maps});
  add_reference_map_node(house.get<scene::NodeRegistry>());
}

}  // namespace parvis::reference_maps
