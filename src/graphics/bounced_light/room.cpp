#include "graphics/bounced_light/room.h"

#include "graphics/bounced_light/bounced_over.h"
#include "graphics/render/light_source.h"
#include "scene/data/bounced_settings.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/scene_builder.h"

namespace parvis::bounced_light {
namespace {

using namespace scene::attribute;

scene::NodeSchema bounced_light_schema() {
  return {
      .type = "bouncedLight",
      .help =
          "Light that streets and facades throw at each other, under sun and sky of any hour: without this "
          "node a constant stands for it.",
      .attributes = {number("spacing",
                            "of the places where light is kept, from side to side; more than "
                            "150,000 of them are spaced wider")
                         .in("m")
                         .between(0.5, 50)
                         .by_default("8"),
                     integer("rays", "from each place, once, when the scene is loaded")
                         .between(16, 1024)
                         .by_default("64")},
      .example = "dayLight(timeOfDay=13)\nbouncedLight(spacing=6)",
      .is_unique = true,
      .is_laid_out_once = true};
}

void build(const scene::Node& node, scene::SceneBuilder& builder) {
  builder.scene.data<scene::BouncedSettings>() = {true, float(node.number("spacing")),
                                                  int(node.integer("rays"))};
}

}  // namespace

void furnish(House& house) {
  house.get<scene::NodeRegistry>().add(bounced_light_schema(), build);
  render::MakeLight& make = house.get<render::Lights>().make;
  make = with_bounced_light(std::move(make));
}

}  // namespace parvis::bounced_light
