#include "life/sound/listening.h"

#include "base/parallel.h"

namespace parvis::sound {
namespace {

constexpr double sound_speed_m_s = 340.0, min_distance_m = 0.5, max_distance_m = 500.0;

}  // namespace

Listening::Listening(const scene::Scene& scene, Output output, const MixerLimits& limits)
    : site_(propagation::site_of(scene)), air_(propagation::absorption_db_per_m({})), mixer_(output, limits) {
  paths_.directions = 72;  // walls that reflect toward the ears are sought at each moment
}

Octaves Listening::level_at(const Emitter& emitter, glm::dvec3 place) const {
  const auto sequences = site_.site->sequences_seen_from(glm::dvec2(place), paths_);
  Octaves levels = site_.site->transfer(emitter.position, place, sequences, paths_, air_).homogeneous_db;
  for (std::size_t band = 0; band < octaves; ++band)
    levels[band] += emitter.power_db[band] - site_.site->grazing_loss(emitter.position, place)[band];
  return levels;
}

void Listening::hear(const scene::Scene& scene, const Camera& ears, double time_s, Buffers buffers) {
  const std::size_t samples = buffers[0].size();
  mixer_.mix(heard(scene, ears, time_s, double(samples) / sample_rate), buffers);
  for (const Bed& bed : beds_of(scene)) bed.add(time_s, buffers);
}

void Listening::hear(std::span<const Emitter> emitters, const Camera& ears, double time_s,
                     std::span<float> left, std::span<float> right) {
  mixer_.mix(heard(emitters, ears, time_s, double(left.size()) / sample_rate), left, right);
}

std::vector<HeardSound> Listening::heard(const scene::Scene& scene, const Camera& ears, double time_s,
                                         double step_s) {
  return heard(sounds_.at(scene, step_s), ears, time_s, step_s);
}

/// Noise of many reflections from four sides. Tones and recordings would be noise in it, and are left out.
void Listening::add_late_field(std::span<const Emitter> emitters, const glm::dvec3& place, double time_s,
                               double step_s, std::vector<HeardSound>& sounds) {
  constexpr double found_again_m = 2.0;
  if (!enclosed_at_ || glm::distance(*enclosed_at_, place) > found_again_m) {
    enclosure_ = enclosure_about(*site_.site, place, paths_.reflections, air_);
    enclosed_at_ = place;
  }
  Octaves power{};
  for (const Emitter& emitter : emitters) {
    if (emitter.kind >= SoundKind::birds || glm::distance(emitter.position, place) > enclosure_.reach_m)
      continue;
    const double fraction = has_events(emitter.kind) ? 0.1 : 1.0;  // as in the mixer
    for (std::size_t band = 0; band < octaves; ++band)
      power[band] += fraction * propagation::energy(emitter.power_db[band] - full_scale_db);
  }
  const Octaves& late = late_.advance(enclosure_, power, step_s);
  constexpr std::array sides{glm::vec3(-1, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0),
                             glm::vec3(0, -1, 0)};
  for (std::size_t side = 0; side < sides.size(); ++side) {
    HeardSound sound{.id = ~std::uint64_t(side), .kind = SoundKind::leaves, .direction = sides[side]};
    for (std::size_t band = 0; band < octaves; ++band) sound.energy[band] = late[band] / double(sides.size());
    sound.emitted_s = time_s;
    if (std::ranges::any_of(sound.energy, [](double energy) { return energy > 1e-16; }))
      sounds.push_back(std::move(sound));
  }
}

std::vector<HeardSound> Listening::heard(std::span<const Emitter> emitters, const Camera& ears, double time_s,
                                         double step_s) {
  const glm::dvec3 place(ears.world_from_camera[3]);
  const glm::mat3 camera_from_world = glm::transpose(glm::mat3(ears.world_from_camera));
  const auto sequences = site_.site->sequences_seen_from(glm::dvec2(place), paths_);
  std::vector<HeardSound> result(emitters.size());
  parallel_for(
      emitters.size(),
      [&](std::size_t i) {
        const Emitter& emitter = emitters[i];
        HeardSound& sound = result[i];
        const glm::dvec3 away = emitter.position - place;
        const double distance_m = std::max(glm::length(away), min_distance_m);
        sound.id = emitter.id, sound.kind = emitter.kind, sound.recording = emitter.recording;
        sound.emitted_s = time_s - distance_m / sound_speed_m_s;
        const glm::vec3 in_camera = camera_from_world * glm::vec3(away / distance_m);
        const glm::vec3 direction(in_camera.x, -in_camera.z, in_camera.y);
        sound.direction = glm::length(direction) > 1e-3f ? glm::normalize(direction) : glm::vec3(0, 1, 0);
        sound.is_visible = sound.direction.y > 0.7f;  // about the field of view
        if (distance_m > max_distance_m) return;
        const Octaves loss = site_.site->grazing_loss(emitter.position, place);
        const Octaves levels =
            site_.site->transfer(emitter.position, place, sequences, paths_, air_).homogeneous_db;
        for (std::size_t band = 0; band < octaves; ++band)
          sound.energy[band] =
              propagation::energy(levels[band] + emitter.power_db[band] - loss[band] - full_scale_db);
      },
      4);
  add_late_field(emitters, place, time_s, step_s, result);
  sources_ = emitters.size();
  return result;
}

}  // namespace parvis::sound
