#include "base/registries.h"
#include "room_list.h"
#include "scene/data/realism.h"
#include "scene/script/attribute.h"
#include "scene/script/scene_builder.h"

namespace parvis::realism {
namespace {

scene::NodeSchema realism_schema() {
  using namespace scene::attribute;
  return {
      .type = "realism",
      .help = "How much of the scene its pictures show, on one scale from a sketch to a photograph.",
      .attributes = {number("level",
                            "0: edges and washes on paper; 0.25: a white model; 0.5: plain colours; 0.75: "
                            "materials without gloss; 1: everything; between them: from one to the next")
                         .between(0, 1)
                         .by_default("1")
                         .live()},
      .example = "realism(level=0.25)",
      .is_unique = true};
}

}  // namespace

/// Adds the node. The lines are drawn by what shows the scene (EdgeLines).
void register_room(Registries& registries) {
  registries.get<scene::NodeRegistry>().add(
      realism_schema(), [](const scene::Node& node, scene::SceneBuilder& builder) {
        builder.scene.data<scene::Realism>().level = float(node.number("level"));
      });
}

}  // namespace parvis::realism
