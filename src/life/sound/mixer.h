// From many sounds to two ears: clusters by place and loudness, premixed, each heard from one direction.
// Tsingos, Gallo and Drettakis 2004 (Perceptual audio rendering of complex virtual environments), with the
// recursive importance of Moeck and others 2007. Departure: steady noise is premixed as energies by octave,
// not as signals, so that its cost does not grow with the number of sources; only the loudest events are
// signals of their own.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "life/sound/ears.h"
#include "life/sound/recording.h"
#include "life/sound/sound_kind.h"

namespace parvis::sound {

/// A sound as it reaches the listener in one moment.
struct HeardSound {
  std::uint64_t id = 0;    ///< the same from moment to moment
  std::uint64_t seed = 0;  ///< of its events: those of a sound and of its reflections are the same
  SoundKind kind = SoundKind::car;
  glm::vec3 direction{0, 1, 0};  ///< unit, from the listener: x right, y ahead, z up
  Octaves energy{};              ///< mean square pressure by octave, in the square of `reference`
  double emitted_s = 0.0;        ///< when it was emitted: earlier by the time of travel
  bool is_visible = false;       ///< visible sounds weigh more where clusters are chosen
  std::shared_ptr<const Recording> recording = {};  ///< `energy` is then as if its octaves were equally loud
};

/// Budgets of the mixer.
struct MixerLimits {
  std::size_t clusters = 24;  ///< directions at a time
  std::size_t events = 64;    ///< events that are signals of their own; further ones are steady noise
  double masked_db = 30.0;  ///< what all quieter sounds together stay below the sum of an octave is not heard
};

/// Leaves of sounds the `count` loudest (A-weighted), in their order: for who cannot mix more.
void keep_loudest(std::vector<HeardSound>& sounds, std::size_t count);

/// Counts of a mix.
struct MixCounts {
  std::size_t sounds = 0, masked = 0, clusters = 0, events = 0;
  double direction_error_rad = 0.0;  ///< mean angle between sounds and their clusters, weighted by energy
};

/// Mixes moments one after the other.
class Mixer {
 public:
  explicit Mixer(Output output, const MixerLimits& limits = {});

  /// Adds what is heard between the last moment and this one to all channels of the output. Amplitude 1 is
  /// the square root of unit energy.
  void mix(std::span<const HeardSound> sounds, Buffers buffers);
  /// The same of outputs with two channels.
  void mix(std::span<const HeardSound> sounds, std::span<float> left, std::span<float> right);
  /// The clusters of a moment of so many samples, before ears or loudspeakers; valid until the next call.
  std::span<const Stream> premix(std::span<const HeardSound> sounds, std::size_t samples);
  /// Counts of the last mix.
  const MixCounts& counts() const { return counts_; }

 private:
  struct Cluster {
    glm::vec3 direction{0, 1, 0}, next_direction{0, 1, 0};
    Octaves amplitude{}, next{};  ///< of its steady noise
    double place = 0.0;
    bool is_used = false;    ///< something sounds in this moment
    bool is_ending = false;  ///< its last sample has not reached the ears yet
  };
  struct Playing {
    SoundKind kind{};
    std::uint64_t seed = 0;
    std::shared_ptr<const Recording> recording;
    double emitted_s = 0.0;
    Octaves amplitude{};
    std::size_t cluster = 0;
    bool is_heard = false;  ///< in this moment
  };

  void choose_clusters(std::span<const HeardSound> sounds);
  void play_events(std::span<const HeardSound> sounds);

  MixerLimits limits_;
  MixCounts counts_;
  std::vector<Cluster> clusters_;
  Spatialiser spatialiser_;
  std::vector<std::size_t> order_, cluster_of_;  // of the sounds of this moment, loudest first; by sound
  std::vector<std::pair<std::uint64_t, Playing>> playing_;
  std::vector<std::vector<float>> signals_;
  std::vector<Stream> streams_;
};

}  // namespace parvis::sound
