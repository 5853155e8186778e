#include "base/registries.h"
#include "reflections/local_maps/local_environment_maps.h"
#include "reflections/local_maps/local_map_settings.h"
#include "reflections/methods/registry.h"
#include "reflections/reference_maps/settings.h"
#include "room_list.h"
#include "scene/script/attribute.h"

namespace parvis::local_maps {
namespace {

scene::AttributeSchema show_attribute() {
  using namespace scene::attribute;
  return choice("show",
                "of local_environment_maps, to look into it: its mesh in red over the maps, or the weights "
                "of the two reference maps in red and green, blue where neither sees what is mirrored",
                {local_map_view_names.begin(), local_map_view_names.end()})
      .by_default(local_map_view_names[0])
      .live();
}

void read_attributes(const scene::Node& node, methods::Settings& settings) {
  read_maps(node, settings);
  for (std::size_t i = 0; i < local_map_view_names.size(); ++i)
    if (node.text("show") == local_map_view_names[i])
      settings.own.get<LocalMapSettings>().shown = LocalMapView(i);
}

}  // namespace

/// Adds them to Parvis's registries.
void register_room(Registries& registries) {
  registries.get<methods::Registry>().add(
      {.name = "local_environment_maps",
       .help = "an environment map for each reflector, made of the two nearest reference maps",
       .make = make_local_environment_maps,
       .attributes = {maps_attribute(), show_attribute()},
       .read = read_attributes,
       .needs_earlier_frames = true});
}

}  // namespace parvis::local_maps
