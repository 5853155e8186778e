#include "base/registries.h"
#include "graphics/lamps/lamp_light.h"
#include "graphics/lamps/lamp_process.h"
#include "graphics/lamps/nodes_lamp.h"
#include "graphics/render/light_source.h"
#include "room_list.h"
#include "scene/action/process.h"
#include "scene/script/node_registry.h"

namespace parvis::lamps {

/// The node lamp, the process that shows what lamps show, and lamps over the light of render::Lights. After
/// the room that chooses that light.
void register_room(Registries& registries) {
  add_lamp_node(registries.get<scene::NodeRegistry>());
  registries.get<action::Processes>().add([] { return std::make_unique<LampProcess>(); });
  render::MakeLight& make = registries.get<render::Lights>().make;
  make = with_lamps(std::move(make));
}

}  // namespace parvis::lamps
