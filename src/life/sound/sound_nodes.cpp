// sound: a source that is heard.
#include "base/registries.h"
#include "life/sound/scene_sounds.h"
#include "room_list.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/scene_builder.h"

namespace parvis::sound {
namespace {

using namespace scene::attribute;

scene::NodeSchema sound_schema() {
  return {
      .type = "sound",
      .help =
          "A source that is heard in parvis sound and in films. Vehicles of traffic and trams sound by "
          "themselves.",
      .attributes =
          {text("name", "by which messages reach it"),
           choice("kind", "what sounds", {sound_names.begin(), sound_names.end()}).required(),
           scene::attribute::vec3("position",
                                  "in the group; of a source that follows an object: forward, "
                                  "left, up from it")
               .in("m")
               .by_default("0 0 0"),
           text("follows", "name of an object that it stays with"),
           number("level_db", "louder than the kind is by itself").in("dB").between(-60, 40).by_default("0"),
           flag("on", "false: it is silent").by_default("1").live()},
      .example = "sound(kind=\"fountain\", position=\"12 4 0.6\", level_db=3)"};
}

void build_sound(const scene::Node& node, scene::SceneBuilder& builder) {
  PlacedSound sound;
  sound.called = node.text("name"), sound.follows = node.text("follows");
  sound.kind = sound_kind(node.text("kind"));
  sound.position = node.vec3("position");
  if (sound.follows.empty())
    sound.position = glm::vec3(builder.world_from_parent() * glm::vec4(sound.position, 1.0f));
  sound.level_db = node.number("level_db"), sound.is_on = node.flag("on");
  builder.add(std::move(sound));
}

}  // namespace

void register_room(Registries& registries) {
  registries.get<scene::NodeRegistry>().add(sound_schema(), build_sound);
}

}  // namespace parvis::sound
