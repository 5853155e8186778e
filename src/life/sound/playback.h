// Sound that goes on by itself: a thread that mixes what was heard last, however seldom pictures are drawn.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <unordered_map>

#include "life/sound/device.h"
#include "life/sound/mixer.h"
#include "life/sound/scene_sounds.h"

namespace parvis::sound {

/// Plays on a device. Where none can be opened, or it goes away, a message says so and it is tried again
/// every few seconds.
class Playback {
 public:
  using OpenDevice = std::function<Result<std::unique_ptr<Device>>(std::size_t streams)>;

  /// Begins; `open` is called by the playing thread. `louder_db`: than a full scale that stands for
  /// `full_scale_db`.
  explicit Playback(OpenDevice open, double louder_db = 20.0, double retry_s = 3.0);
  ~Playback();

  /// Sets the sounds of this moment, at a time of the scene's clock. Directions, energies and delays go
  /// evenly from those of the last call to these, in as much time as passed between the two; then they stay.
  void update(std::vector<HeardSound> heard, std::vector<Bed> beds, double time_s);

  /// Fades all out, or in again.
  void mute(bool is_muted);
  bool is_muted() const;

  /// The latest message to the visitor that was not taken yet; empty for none.
  std::string take_message();
  /// The fraction of a core that mixing takes, smoothed over a second, and the voices that were mixed last.
  struct Cost {
    double core_fraction = 0.0;
    std::size_t voices = 0;
  };
  Cost cost() const;
  /// Moments played so far.
  std::size_t moments() const;

 private:
  /// The sounds of one call of update.
  struct Snapshot {
    std::unordered_map<std::uint64_t, HeardSound> sounds;  ///< `emitted_s` is the delay
    double begin_s = 0.0;                                  ///< of the thread's time
  };

  void run();
  std::vector<HeardSound> sounds_at(double now_s) const;
  void say(std::string text);
  void note_cost(double mixing_s, std::size_t voices);

  OpenDevice open_;
  double gain_, retry_s_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Snapshot before_, now_;
  std::vector<Bed> beds_;
  bool is_muted_ = false, ends_ = false;
  std::string message_;
  std::size_t moments_ = 0;
  Cost cost_;
  std::thread thread_;  ///< last: it uses all others
};

}  // namespace parvis::sound
