// What somebody hears in a scene: the emitters of each moment, what reaches the listener by CNOSSOS-EU, and
// the mix.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include "base/camera.h"
#include "life/propagation/air.h"
#include "life/propagation/scene_site.h"
#include "life/sound/late_field.h"
#include "life/sound/mixer.h"
#include "life/sound/scene_sounds.h"

namespace parvis::sound {

/// Hears a scene; propagation is that of the map of noise, in homogeneous conditions, without the long-term
/// mean, and beyond its orders of reflection a late field.
class Listening {
 public:
  /// Takes the scene's static objects as they stand.
  Listening(const scene::Scene& scene, Output output, const MixerLimits& limits = {});

  /// Adds what is heard in the samples before the present moment, at which the clock shows `time_s`, beds
  /// included.
  void hear(const scene::Scene& scene, const Camera& ears, double time_s, Buffers buffers);
  /// The same of given emitters, for outputs with two channels.
  void hear(std::span<const Emitter> emitters, const Camera& ears, double time_s, std::span<float> left,
            std::span<float> right);

  /// The sounds of a scene as they reach the ears, `step_s` after the last call; for those who mix
  /// themselves.
  std::vector<HeardSound> heard(const scene::Scene& scene, const Camera& ears, double time_s, double step_s);

  /// Level in dB by octave of one emitter at a place: the transfer that is heard.
  Octaves level_at(const Emitter& emitter, glm::dvec3 place) const;
  /// Number of sources of the last call.
  std::size_t sources() const { return sources_; }
  /// Counts of the last mix.
  const MixCounts& counts() const { return mixer_.counts(); }
  /// The site in which sound goes about.
  const propagation::Site& site() const { return *site_.site; }

 private:
  std::vector<HeardSound> heard(std::span<const Emitter> emitters, const Camera& ears, double time_s,
                                double step_s);
  std::vector<HeardSound> heard_of(const Emitter& emitter, const Camera& ears, double time_s,
                                   std::span<const propagation::SoundPath> paths) const;
  void find_paths(std::span<const Emitter> emitters, const glm::dvec3& place);
  void add_late_field(std::span<const Emitter> emitters, const glm::dvec3& place, double time_s,
                      double step_s, std::vector<HeardSound>& sounds);

  propagation::SceneSite site_;
  propagation::PathChoice paths_;
  Octaves air_;
  Mixer mixer_;
  SceneSounds sounds_;
  Enclosure enclosure_, covered_;          ///< the open place, and what lies below the ceiling over the ears
  std::optional<glm::dvec3> enclosed_at_;  ///< where the enclosure was found
  // While the ears stay where they are, paths from a place to them are kept; sources in one place share them.
  using PlaceKey = std::tuple<long, long, long>;  // centimetres
  static PlaceKey key_of(const glm::dvec3& place);
  std::optional<glm::dvec3> paths_lead_to_;
  std::vector<propagation::WallSequence> sequences_;
  std::map<PlaceKey, std::vector<propagation::SoundPath>> found_paths_;
  LateField late_, late_below_;
  std::size_t sources_ = 0;
};

}  // namespace parvis::sound
