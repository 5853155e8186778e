#include "graphics/lamps/nodes_lamp.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "base/colour.h"
#include "graphics/light/day_light.h"
#include "graphics/light/spectrum.h"
#include "scene/data/lamp.h"
#include "scene/script/attribute.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"

namespace parvis::lamps {
namespace {

scene::NodeSchema lamp_schema() {
  using namespace scene::attribute;
  scene::NodeSchema schema{
      .type = "lamp",
      .help =
          "A street lamp, a shop window, a headlight: by itself, or one on every object of some name, with "
          "which it goes. Where more than eight lamps reach the same 6 m, the eight brightest shine.",
      .attributes =
          {text("name", "by which other nodes refer to it"),
           text("of",
                "names of objects, with * and ?: each has such a lamp; without it the lamp stands by itself"),
           text("part",
                "of the objects' model: the lamp is in its middle, and of a pair one is in each; position is "
                "added"),
           vec3("position", "in the frame of its object, or of its group").in("m").by_default("0 0 0").live(),
           vec3("direction", "of the cone, in the same frame, of any length").by_default("0 0 -1").live(),
           angle("angle_deg", "opening of its cone; 360: it shines all round")
               .in("degrees")
               .between(1, 360)
               .by_default("360")
               .live(),
           number("flux_lm", "all the light that it gives; a street lamp has 3,000 to 10,000")
               .in("lm")
               .between(0, 1e7)
               .by_default("4000")
               .live(),
           colour("colour", "of its light; how bright it is does not count").by_default("1 0.76 0.45").live(),
           number("reach", "beyond it there is no light").in("m").between(0.1, 200).by_default("20").live(),
           number("radius", "what lies so near to the lamp's middle glows: its glass")
               .in("m")
               .between(0, 10)
               .by_default("0.2")
               .live(),
           choice("burns", "dusk: while daylight is below 60 lux, which only dayLight can tell",
                  {"dusk", "always", "never"})
               .by_default("dusk")
               .live(),
           text("shows", "names of objects, with * and ?, that are seen only while it burns: lit windows")},
      .example =
          "model(name=\"post 1\", file=\"lamp_post.glb\", position=\"4 0 0\")\n"
          "lamp(of=\"post *\", position=\"0 0 4.5\", flux_lm=5000)\n"
          "lamp(of=\"vehicle *\", part=\"lamp\", direction=\"1 0 -0.06\", angle_deg=60, flux_lm=1500)"};
  schema.attributes.push_back(scene::visible_attribute());
  return schema;
}

/// W/sr of each channel: as bright as the flux says, weighted by the eye.
glm::vec3 intensity_of(const scene::Node& node, float half_angle) {
  const glm::vec3 colour = node.vec3("colour");
  const float solid_angle = 2.0f * glm::pi<float>() * (1.0f - std::cos(half_angle));
  const float candela = float(node.number("flux_lm")) / solid_angle;
  return candela / float(light::lumens_per_watt) / luminance(colour) * colour;
}

void build_lamp(const scene::Node& node, scene::SceneBuilder& builder) {
  if (!builder.is_visible() || !node.flag("visible")) return;
  scene::Lamp lamp;
  lamp.of = node.text("of"), lamp.part = node.text("part"), lamp.shows = node.text("shows");
  if (!lamp.part.empty() && lamp.of.empty())
    return builder.fail(
        error_at(node.where_of("part"), "part= names a part of the objects that of= names; give of=, too"));
  if (!(luminance(node.vec3("colour")) > 0.0f))
    return builder.fail(error_at(node.where_of("colour"), "the lamp's colour is black; use flux_lm=0"));
  const glm::vec3 direction = node.vec3("direction");
  if (glm::length(direction) < 1e-6f)
    return builder.fail(
        error_at(node.where_of("direction"), "the lamp's direction has no length; give \"0 0 -1\", say"));
  lamp.position = node.vec3("position"), lamp.axis = glm::normalize(direction);
  if (lamp.of.empty()) {
    const glm::mat4& world = builder.world_from_parent();
    lamp.position = glm::vec3(world * glm::vec4(lamp.position, 1.0f));
    lamp.axis = glm::normalize(glm::mat3(world) * lamp.axis);
  }
  lamp.half_angle = 0.5f * node.angle("angle_deg");
  lamp.intensity = intensity_of(node, lamp.half_angle);
  lamp.reach_m = float(node.number("reach")), lamp.radius_m = float(node.number("radius"));
  const std::string& burns = node.text("burns");
  lamp.burns = burns == "always"  ? scene::LampSwitch::always
               : burns == "never" ? scene::LampSwitch::never
                                  : scene::LampSwitch::dusk;
  builder.add(std::move(lamp));
  light::adapt(builder.scene);
}

}  // namespace

void add_lamp_node(scene::NodeRegistry& registry) { registry.add(lamp_schema(), build_lamp); }

}  // namespace parvis::lamps
