// From many sounds to two ears: clusters by place and loudness, premixed, each heard from one direction.
// Tsingos, Gallo and Drettakis 2004 (Perceptual audio rendering of complex virtual environments), with the
// recursive importance of Moeck and others 2007. Departure: steady noise is premixed as energies by octave,
// not as signals, so that its cost does not grow with the number of sources; only the loudest events are
// signals of their own.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "life/sound/sound_kind.h"

namespace parvis::sound {

/// A sound as it reaches the listener in one moment.
struct HeardSound {
  std::uint64_t id = 0;  ///< the same from moment to moment; the seed of its events
  SoundKind kind = SoundKind::car;
  glm::vec3 direction{0, 1, 0};  ///< unit, from the listener: x right, y ahead, z up
  Octaves energy{};              ///< mean square pressure by octave, in the square of `reference`
  double emitted_s = 0.0;        ///< when it was emitted: earlier by the time of travel
  bool is_visible = false;       ///< visible sounds weigh more where clusters are chosen
};

/// Which ears or loudspeakers.
enum class Output {
  headphones,  ///< a spherical head of 8.75 cm (Woodworth's delay; shadow of Brown and Duda 1998)
  stereo,      ///< two loudspeakers, 30 degrees to the left and right, by equal power
  microphone   ///< both channels alike, without directions: levels are those of a sound level meter
};

/// Budgets of the mixer.
struct MixerLimits {
  std::size_t clusters = 24;  ///< directions at a time
  std::size_t events = 64;    ///< events that are signals of their own; further ones are steady noise
  double masked_db = 30.0;  ///< what all quieter sounds together stay below the sum of an octave is not heard
};

/// Counts of a mix.
struct MixCounts {
  std::size_t sounds = 0, masked = 0, clusters = 0, events = 0;
  double direction_error_rad = 0.0;  ///< mean angle between sounds and their clusters, weighted by energy
};

/// Mixes moments one after the other.
class Mixer {
 public:
  explicit Mixer(Output output, const MixerLimits& limits = {});

  /// Adds what is heard between the last moment and this one to both channels, which are equally long.
  /// Amplitude 1 is the square root of unit energy.
  void mix(std::span<const HeardSound> sounds, std::span<float> left, std::span<float> right);
  /// Counts of the last mix.
  const MixCounts& counts() const { return counts_; }

 private:
  struct Cluster {
    glm::vec3 direction{0, 1, 0}, next_direction{0, 1, 0};
    Octaves amplitude{}, next{};  ///< of its steady noise
    double place = 0.0, rate = 1.0;
    bool is_used = false;
    std::array<float, 2> shadow_in{}, shadow_out{};  ///< the last sample of each ear's filter
    std::vector<float> past;                         ///< samples before this moment, for delays
  };
  struct Playing {
    SoundKind kind{};
    double emitted_s = 0.0;
    Octaves amplitude{};
    std::size_t cluster = 0;
    bool is_heard = false;  ///< in this moment
  };

  void choose_clusters(std::span<const HeardSound> sounds);
  void play_events(std::span<const HeardSound> sounds);
  void spatialise(Cluster& cluster, std::span<const float> signal, std::span<float> left,
                  std::span<float> right) const;

  Output output_;
  MixerLimits limits_;
  MixCounts counts_;
  std::vector<Cluster> clusters_;
  std::vector<std::size_t> order_, cluster_of_;  // of the sounds of this moment, loudest first; by sound
  std::vector<std::pair<std::uint64_t, Playing>> playing_;
  std::vector<std::vector<float>> signals_;
};

}  // namespace parvis::sound
