// What sounds in a scene: its sound nodes, vehicles and trams.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "life/propagation/site.h"
#include "life/sound/ears.h"
#include "life/sound/recording.h"
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
  std::shared_ptr<const Recording> recording;  ///< of recordings and beds

  /// Adds all members; see SceneData.
  void hash(ContentHash& hash) const {
    hash.add_text(called), hash.add_text(follows);
    hash.add(int(kind)), hash.add(position), hash.add(level_db), hash.add(is_on);
    hash.add(recording ? recording->loudness_lufs : 0.0), hash.add(recording ? recording->length_s() : 0.0);
  }
};

/// A sound of one moment.
struct Emitter {
  std::uint64_t id = 0;
  SoundKind kind{};
  glm::dvec3 position{0.0};
  Octaves power_db{};  ///< dB re 1 pW; of a recording, as if its octaves were equally loud
  std::shared_ptr<const Recording> recording = {};
};

/// A bed that is heard in one moment.
struct Bed {
  std::shared_ptr<const Recording> recording;
  float gain =
      1.0f;  ///< of its samples, so that its loudness is its level where amplitude 1 is `full_scale_db`

  /// Adds the samples before a time to the first two channels, each times the gain and nothing else.
  void add(double time_s, Buffers buffers) const;
};

/// Level in dB re 20 µPa of a signal whose root mean square is 1.
inline constexpr double full_scale_db = 100.0;
/// Level in dB(A) of beds, and of recordings at 1 m, whose `level_db` is 0.
inline constexpr double recording_db = 60.0;

/// Whether an object of this name is a fountain: "fountain", "fountain 2", "the fountain".
bool is_fountain(std::string_view name);

/// Beds of a scene that are on.
std::vector<Bed> beds_of(const scene::Scene& scene);

/// Follows what sounds from moment to moment, for speeds.
class SceneSounds {
 public:
  /// Emitters of the scene as it stands, `step_s` after the last call, for ears at a place: its sound nodes
  /// and noise sources, vehicles (the model's name says whether they are buses), trams, fountains (objects of
  /// that name), and of people and trees those that are near. What is hidden is silent. `terrain`: the ground
  /// that feet tread on; null: it is hard.
  std::vector<Emitter> at(const scene::Scene& scene, double step_s, const glm::dvec3& ears,
                          const propagation::Terrain* terrain = nullptr);

 private:
  /// Something as it was at the last call.
  struct Seen {
    glm::dvec3 position{0.0};
    float doors_m = 0.0f;  ///< by which the leaves of a tram's section are open, all together
    double rings_until_s = -1.0;
    bool is_at_rest = false;
  };
  double speed_of(std::uint64_t id, glm::dvec3 position, double step_s);
  void add_placed(const scene::Scene& scene, double step_s, std::vector<Emitter>& emitters);
  void add_trams(const scene::Scene& scene, double step_s, std::vector<Emitter>& emitters);
  void add_people(const scene::Scene& scene, double step_s, const glm::dvec3& ears,
                  const propagation::Terrain* terrain, std::vector<Emitter>& emitters);
  void add_trees(const scene::Scene& scene, const glm::dvec3& ears, std::vector<Emitter>& emitters) const;

  std::unordered_map<std::uint64_t, Seen> last_, now_;
  double time_s_ = 0.0;
};

}  // namespace parvis::sound
