// What sounds in a scene: its sound nodes, vehicles and trams.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "life/sound/sound_kind.h"
#include "scene/data/scene.h"

namespace parvis::sound {

/// The item that the node `sound` makes.
struct PlacedSound {
  static constexpr std::string_view name = "sound.placed";
  static constexpr scene::DataRole role = scene::DataRole::settings;  // heard, not seen
  std::string called;
  SoundKind kind = SoundKind::fountain;
  glm::vec3 position{0.0f};  ///< in the world, or from the object that it follows: forward, left, up
  std::string follows;       ///< name of an object; empty: it stays
  double level_db = 0.0;     ///< louder than the kind is by itself
  bool is_on = true;

  /// Adds all members; see SceneData.
  void hash(ContentHash& hash) const {
    hash.add_text(called), hash.add_text(follows);
    hash.add(int(kind)), hash.add(position), hash.add(level_db), hash.add(is_on);
  }
};

/// A sound of one moment.
struct Emitter {
  std::uint64_t id = 0;
  SoundKind kind{};
  glm::dvec3 position{0.0};
  Octaves power_db{};  ///< dB re 1 pW
};

/// Follows what sounds from moment to moment, for speeds.
class SceneSounds {
 public:
  /// Emitters of the scene as it stands, `step_s` after the last call. Vehicles are the objects of traffic,
  /// whose model's name says whether they are buses; trams roll under each section and have fans on the roof
  /// of the first. What is hidden is silent.
  std::vector<Emitter> at(const scene::Scene& scene, double step_s);

 private:
  double speed_of(std::uint64_t id, glm::dvec3 position, double step_s);

  std::unordered_map<std::uint64_t, glm::dvec3> last_, now_;
};

}  // namespace parvis::sound
