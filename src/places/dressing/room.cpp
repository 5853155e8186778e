#include "base/registries.h"
#include "places/dressing/nodes_lit_windows.h"
#include "places/dressing/nodes_surfaces.h"
#include "places/dressing/nodes_terrain.h"
#include "room_list.h"

namespace parvis::dressing {

/// Adds the node types of this room and their finish steps, which come before those of roads: carriageways
/// are laid on the ground that is made here.
void register_room(Registries& registries) {
  scene::NodeRegistry& registry = registries.get<scene::NodeRegistry>();
  add_terrain_nodes(registry);
  add_surface_nodes(registry);
  add_lit_windows_node(registry);
}

}  // namespace parvis::dressing
