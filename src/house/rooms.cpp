#include "house/rooms.h"

#include "places/paper_city/city_nodes.h"
#include "reflections/environment_rays/room.h"
#include "reflections/local_maps/room.h"
#include "reflections/probes/room.h"
#include "reflections/reference_maps/room.h"
#include "reflections/refraction/room.h"
#include "reflections/virtual_objects/room.h"
#include "scene/action/action_nodes.h"

namespace parvis::house {

const House& all_rooms() {
  static const House house = [] {
    House all;
    scene::NodeRegistry& nodes = all.get<scene::NodeRegistry>();
    nodes = scene::core_nodes();
    city::add_city_nodes(nodes);
    action::add_action_nodes(nodes);
    probes::furnish(all);
    environment_rays::furnish(all);
    local_maps::furnish(all);
    reference_maps::furnish(all);
    virtual_objects::furnish(all);
    refraction::furnish(all);
    methods::add_reflection_node(nodes, all.get<methods::Registry>());
    return all;
  }();
  return house;
}

}  // namespace parvis::house
