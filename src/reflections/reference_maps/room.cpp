#include "base/registries.h"
#include "graphics/render/bake_steps.h"
#include "reflections/methods/registry.h"
#include "reflections/reference_maps/bake_step.h"
#include "reflections/reference_maps/map_cache.h"
#include "reflections/reference_maps/reference_map_node.h"
#include "reflections/reference_maps/settings.h"
#include "reflections/reference_maps/simple_blend.h"
#include "room_list.h"

namespace parvis::reference_maps {

/// Adds them to Parvis's registries.
void register_room(Registries& registries) {
  registries.get<methods::Registry>().add(
      {.name = "simple_blend",
       .help = "the two nearest reference maps, blended as if they were infinitely far",
       .make = make_simple_blend,
       .attributes = {maps_attribute()},
       .read = read_maps});
  registries.get<render::BakeSteps>().add(
      {.name = "reference maps", .run = bake_and_plan, .forget_others = forget_other_states});
  add_reference_map_node(registries.get<scene::NodeRegistry>());
}

}  // namespace parvis::reference_maps
