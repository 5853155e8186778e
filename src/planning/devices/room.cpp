#include "base/registries.h"
#include "planning/devices/haptic.h"
#include "room_list.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/scene_builder.h"

namespace parvis::devices {
namespace {

scene::NodeSchema haptic_schema() {
  using namespace scene::attribute;
  return {.type = "haptic",
          .help = "What the hand on a gamepad or wand feels when something happens to the planner's tool.",
          .attributes = {text("name", "by which messages reach it"),
                         choice("on",
                                "what happens: something snaps, or the eye or a thing meets an obstacle, or "
                                "an object is selected",
                                {felt_names.begin(), felt_names.end()})
                             .required(),
                         number("rumble", "of the slow motor").between(0, 1).by_default("0.6").live(),
                         number("buzz", "of the fast motor").between(0, 1).by_default("0.3").live(),
                         number("force", "of force feedback, of the device's greatest")
                             .between(0, 1)
                             .by_default("0.5")
                             .live(),
                         number("seconds", "how long").in("s").between(0.01, 2).by_default("0.08").live()},
          .example = "haptic(on=snapping, rumble=0.2, seconds=0.05)"};
}

}  // namespace

/// Adds the node. Windows that have a gamepad or a wand play it.
void register_room(Registries& registries) {
  registries.get<scene::NodeRegistry>().add(
      haptic_schema(), [](const scene::Node& node, scene::SceneBuilder& builder) {
        HapticEffect effect;
        effect.on = Felt(std::ranges::find(felt_names, node.text("on")) - felt_names.begin());
        effect.pulse = {float(node.number("rumble")), float(node.number("buzz")), float(node.number("force")),
                        float(node.number("seconds"))};
        builder.add(effect);
      });
}

}  // namespace parvis::devices
