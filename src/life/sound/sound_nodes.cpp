// sound: a source that is heard.
#include <map>
#include <mutex>

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
          "A source that is heard in the window, in parvis sound and in films. Vehicles of traffic and trams "
          "sound by themselves.",
      .attributes = {text("name", "by which messages reach it"),
                     choice("kind", "what sounds; bed: a recording in stereo that is heard everywhere",
                            {sound_names.begin(), sound_names.end()})
                         .required(),
                     file("file",
                          "of a recording or a bed: WAVE, FLAC or Ogg Vorbis; it is heard over and over"),
                     scene::attribute::vec3("position",
                                            "in the group; of a source that follows an object: forward, "
                                            "left, up from it")
                         .in("m")
                         .by_default("0 0 0"),
                     text("follows", "name of an object that it stays with"),
                     number("level_db",
                            "louder than the kind is by itself; than 60 dB(A): a recording at 1 m, or a bed")
                         .in("dB")
                         .between(-60, 40)
                         .by_default("0"),
                     flag("on", "false: it is silent").by_default("1").live()},
      .example = "sound(kind=\"fountain\", position=\"12 4 0.6\", level_db=3)"};
}

/// Recordings of scenes that are there now, by file: a node that changes reads nothing again.
class KnownRecordings {
 public:
  std::shared_ptr<const Recording> read(const scene::Node& node, scene::SceneBuilder& builder) {
    const std::filesystem::path file = node.file("file");
    std::error_code code;
    const auto changed = std::filesystem::last_write_time(file, code).time_since_epoch().count();
    const std::lock_guard lock(mutex_);
    std::weak_ptr<const Recording>& known = recordings_[fmt::format("{}?{}", file.string(), changed)];
    if (auto held = known.lock()) return held;
    Result<Recording> read = read_recording(file);
    if (!read) {
      builder.fail(read.errors(), node.where_of("file"));
      return nullptr;
    }
    auto recording = std::make_shared<const Recording>(*std::move(read));
    known = recording;
    return recording;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::weak_ptr<const Recording>> recordings_;
};

void build_sound(const scene::Node& node, scene::SceneBuilder& builder, KnownRecordings& known) {
  PlacedSound sound;
  sound.called = node.text("name"), sound.follows = node.text("follows");
  sound.kind = sound_kind(node.text("kind"));
  const bool is_recorded = sound.kind == SoundKind::recording || sound.kind == SoundKind::bed;
  if (is_recorded != node.gives("file"))
    return builder.fail(
        is_recorded ? error_at(node.where, "a sound of the kind \"{}\" needs a file=", node.text("kind"))
                    : error_at(node.where_of("file"),
                               "only recordings and beds have a file; expected "
                               "kind=\"recording\" or kind=\"bed\""));
  if (is_recorded && !(sound.recording = known.read(node, builder))) return;
  sound.position = node.vec3("position");
  if (sound.follows.empty())
    sound.position = glm::vec3(builder.world_from_parent() * glm::vec4(sound.position, 1.0f));
  sound.level_db = node.number("level_db"), sound.is_on = node.flag("on");
  builder.add(std::move(sound));
}

}  // namespace

void register_room(Registries& registries) {
  const auto known = std::make_shared<KnownRecordings>();
  registries.get<scene::NodeRegistry>().add(
      sound_schema(),
      [known](const scene::Node& node, scene::SceneBuilder& builder) { build_sound(node, builder, *known); });
}

}  // namespace parvis::sound
