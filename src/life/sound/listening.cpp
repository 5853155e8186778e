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

void Listening::hear(const scene::Scene& scene, const Camera& ears, double time_s, std::span<float> left,
                     std::span<float> right) {
  hear(sounds_.at(scene, double(left.size()) / sample_rate), ears, time_s, left, right);
}

void Listening::hear(std::span<const Emitter> emitters, const Camera& ears, double time_s,
                     std::span<float> left, std::span<float> right) {
  const glm::dvec3 place(ears.world_from_camera[3]);
  const glm::mat3 camera_from_world = glm::transpose(glm::mat3(ears.world_from_camera));
  const auto sequences = site_.site->sequences_seen_from(glm::dvec2(place), paths_);
  std::vector<HeardSound> heard(emitters.size());
  parallel_for(
      emitters.size(),
      [&](std::size_t i) {
        const Emitter& emitter = emitters[i];
        HeardSound& sound = heard[i];
        const glm::dvec3 away = emitter.position - place;
        const double distance_m = std::max(glm::length(away), min_distance_m);
        sound.id = emitter.id, sound.kind = emitter.kind;
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
  mixer_.mix(heard, left, right);
}

}  // namespace parvis::sound
