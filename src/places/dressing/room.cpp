#include "places/dressing/room.h"

#include "places/dressing/nodes_surfaces.h"
#include "places/dressing/nodes_terrain.h"

namespace parvis::dressing {

void furnish(House& house) {
  scene::NodeRegistry& registry = house.get<scene::NodeRegistry>();
  add_terrain_nodes(registry);
  add_surface_nodes(registry);
}

}  // namespace parvis::dressing
