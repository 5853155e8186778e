// What somebody hears in a scene: the emitters of each moment, what reaches the listener by CNOSSOS-EU, and
// the mix.
#pragma once

#include <memory>

#include "base/camera.h"
#include "life/propagation/air.h"
#include "life/propagation/scene_site.h"
#include "life/sound/mixer.h"
#include "life/sound/scene_sounds.h"

namespace parvis::sound {

/// Level in dB re 20 µPa of a signal whose root mean square is 1.
inline constexpr double full_scale_db = 100.0;

/// Hears a scene; propagation is that of the map of noise, in homogeneous conditions, without the long-term
/// mean.
class Listening {
 public:
  /// Takes the scene's static objects as they stand.
  Listening(const scene::Scene& scene, Output output, const MixerLimits& limits = {});

  /// Adds what is heard in the `left.size()` samples before the present moment, at which the clock shows
  /// `time_s`.
  void hear(const scene::Scene& scene, const Camera& ears, double time_s, std::span<float> left,
            std::span<float> right);
  /// The same of given emitters.
  void hear(std::span<const Emitter> emitters, const Camera& ears, double time_s, std::span<float> left,
            std::span<float> right);

  /// Level in dB by octave of one emitter at a place: the transfer that is heard.
  Octaves level_at(const Emitter& emitter, glm::dvec3 place) const;
  /// Counts of the last mix.
  const MixCounts& counts() const { return mixer_.counts(); }
  /// The site in which sound goes about.
  const propagation::Site& site() const { return *site_.site; }

 private:
  propagation::SceneSite site_;
  propagation::PathChoice paths_;
  Octaves air_;
  Mixer mixer_;
  SceneSounds sounds_;
};

}  // namespace parvis::sound
