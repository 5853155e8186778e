#include "graphics/lamps/room.h"

#include "graphics/lamps/lamp_light.h"
#include "graphics/lamps/lamp_process.h"
#include "graphics/lamps/nodes_lamp.h"
#include "graphics/render/light_source.h"
#include "scene/action/process.h"
#include "scene/script/node_registry.h"

namespace parvis::lamps {

void furnish(House& house) {
  add_lamp_node(house.get<scene::NodeRegistry>());
  house.get<action::Processes>().add([] { return std::make_unique<LampProcess>(); });
  render::MakeLight& make = house.get<render::Lights>().make;
  make = with_lamps(std::move(make));
}

}  // namespace parvis::lamps
