#include "life/sound/listening.h"

#include <numeric>

#include "base/parallel.h"

namespace parvis::sound {
namespace {

constexpr double sound_speed_m_s = 340.0, min_distance_m = 0.5, max_distance_m = 500.0;

/// Water splashes about a fountain's stone: that is no wall before its own sound.
scene::Scene without_fountains(const scene::Scene& scene) {
  scene::Scene result = scene;
  for (scene::Object& object : result.objects) object.is_visible &= !is_fountain(object.name);
  return result;
}

}  // namespace

Listening::Listening(const scene::Scene& scene, Output output, const MixerLimits& limits)
    : site_(propagation::site_of(without_fountains(scene))),
      air_(propagation::absorption_db_per_m({})),
      mixer_(output, limits) {
  paths_.directions = 72;  // walls that reflect toward the ears are sought at each moment
  paths_.softens_shadows = true;
}

Octaves Listening::level_at(const Emitter& emitter, glm::dvec3 place) const {
  const auto sequences = site_.site->sequences_seen_from(place, paths_);
  Octaves levels = site_.site->transfer(emitter.position, place, sequences, paths_, air_).homogeneous_db;
  for (std::size_t band = 0; band < octaves; ++band) levels[band] += emitter.power_db[band];
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
  const glm::dvec3 place(ears.world_from_camera[3]);
  return heard(sounds_.at(scene, step_s, place, site_.terrain.get()), ears, time_s, step_s);
}

/// Noise of many reflections from four sides. Tones and recordings would be noise in it, and are left out.
void Listening::add_late_field(std::span<const Emitter> emitters, const glm::dvec3& place, double time_s,
                               double step_s, std::vector<HeardSound>& sounds) {
  constexpr double found_again_m = 2.0;
  if (!enclosed_at_ || glm::distance(*enclosed_at_, place) > found_again_m) {
    enclosure_ = enclosure_about(*site_.site, place, paths_.reflections, air_);
    covered_ = covered_about(*site_.site, place, paths_.reflections, air_);
    enclosed_at_ = place;
  }
  const auto is_covered = [&](const glm::dvec3& at) {
    const std::optional<double> ceiling = site_.terrain->ceiling_z(glm::dvec2(at));
    return ceiling && at.z < *ceiling;
  };
  Octaves power{}, power_below{};
  for (const Emitter& emitter : emitters) {
    // Below a ceiling elsewhere, it is heard as through the openings.
    const double distance_m = glm::distance(emitter.position, place);
    const bool is_below = distance_m <= covered_.reach_m && is_covered(emitter.position);
    if (emitter.kind >= SoundKind::birds || (!is_below && distance_m > enclosure_.reach_m)) continue;
    const double fraction = has_events(emitter.kind) ? 0.1 : 1.0;  // as in the mixer
    for (std::size_t band = 0; band < octaves; ++band)
      (is_below ? power_below : power)[band] +=
          fraction * propagation::energy(emitter.power_db[band] - full_scale_db);
  }
  const Octaves &late = late_.advance(enclosure_, power, step_s),
                &below = late_below_.advance(covered_, power_below, step_s);
  constexpr std::array sides{glm::vec3(-1, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0),
                             glm::vec3(0, -1, 0)};
  for (std::size_t side = 0; side < sides.size(); ++side) {
    HeardSound sound{.id = ~std::uint64_t(side), .kind = SoundKind::leaves, .direction = sides[side]};
    for (std::size_t band = 0; band < octaves; ++band)
      sound.energy[band] = (late[band] + below[band]) / double(sides.size());
    sound.emitted_s = time_s;
    if (std::ranges::any_of(sound.energy, [](double energy) { return energy > 1e-16; }))
      sounds.push_back(std::move(sound));
  }
}

/// The sounds of one emitter: one that comes straight or round edges, from the mean of its directions, and
/// the strongest reflections, from where and as late as they come: image sources.
std::vector<HeardSound> Listening::heard_of(const Emitter& emitter, const Camera& ears, double time_s,
                                            std::span<const propagation::SoundPath> paths) const {
  constexpr std::size_t max_reflections = 3;
  const glm::dvec3 place(ears.world_from_camera[3]);
  const glm::mat3 camera_from_world = glm::transpose(glm::mat3(ears.world_from_camera));
  const auto placed = [&](const glm::dvec3& from, double length_m, const Octaves& energy) {
    HeardSound sound{.id = emitter.id, .seed = emitter.id, .kind = emitter.kind, .energy = energy};
    sound.recording = emitter.recording;
    sound.emitted_s = time_s - std::max(length_m, min_distance_m) / sound_speed_m_s;
    const glm::vec3 in_camera = camera_from_world * glm::vec3(from);
    const glm::vec3 direction(in_camera.x, -in_camera.z, in_camera.y);
    if (glm::length(direction) > 1e-3f) sound.direction = glm::normalize(direction);
    return sound;
  };
  const double distance_m = glm::distance(emitter.position, place);
  if (paths.empty()) return {placed(emitter.position - place, distance_m, {})};  // it is too far away

  std::vector<HeardSound> reflected;
  Octaves direct{};
  glm::dvec3 from(0.0);
  double length_m = 0.0, weight = 0.0;
  for (const propagation::SoundPath& path : paths) {
    Octaves energy;
    for (std::size_t band = 0; band < octaves; ++band)
      energy[band] = propagation::energy(emitter.power_db[band] - path.attenuation_db[band] - full_scale_db);
    const glm::dvec3 away = path.comes_from - place;
    if (path.walls) {
      HeardSound sound = placed(away, path.length_m, energy);
      for (const int wall : *path.walls) sound.id = sound.id * 1'000'003u + std::uint64_t(wall) + 1u;
      reflected.push_back(std::move(sound));
      continue;
    }
    const double sum = std::accumulate(energy.begin(), energy.end(), 1e-30);
    for (std::size_t band = 0; band < octaves; ++band) direct[band] += energy[band];
    from += sum * away / std::max(glm::length(away), 1e-6), length_m += sum * path.length_m, weight += sum;
  }
  if (reflected.size() > max_reflections) {
    std::vector<HeardSound> all = reflected;
    keep_loudest(reflected, max_reflections);
    for (const HeardSound& sound : all)
      if (std::ranges::find(reflected, sound.id, &HeardSound::id) == reflected.end())
        for (std::size_t band = 0; band < octaves; ++band) direct[band] += sound.energy[band];
  }
  reflected.push_back(placed(from / weight, length_m / weight, direct));
  reflected.back().is_visible = reflected.back().direction.y > 0.7f;  // about the field of view
  return reflected;
}

Listening::PlaceKey Listening::key_of(const glm::dvec3& place) {
  return {std::lround(100.0 * place.x), std::lround(100.0 * place.y), std::lround(100.0 * place.z)};
}

void Listening::find_paths(std::span<const Emitter> emitters, const glm::dvec3& place) {
  constexpr double same_m = 1e-3;
  constexpr std::size_t max_kept = 20'000;
  if (!paths_lead_to_ || glm::distance(*paths_lead_to_, place) > same_m || found_paths_.size() > max_kept) {
    paths_lead_to_ = place, found_paths_.clear();
    sequences_ = site_.site->sequences_seen_from(place, paths_);
  }
  std::vector<std::pair<glm::dvec3, std::vector<propagation::SoundPath>*>> lacking;
  for (const Emitter& emitter : emitters) {
    if (!(glm::distance(emitter.position, place) <= max_distance_m)) continue;
    const auto [found, is_new] = found_paths_.try_emplace(key_of(emitter.position));
    if (is_new) lacking.emplace_back(emitter.position, &found->second);
  }
  parallel_for(
      lacking.size(),
      [&](std::size_t i) {
        *lacking[i].second = site_.site->paths(lacking[i].first, place, sequences_, paths_, air_,
                                               propagation::Condition::homogeneous);
      },
      4);
}

std::vector<HeardSound> Listening::heard(std::span<const Emitter> emitters, const Camera& ears, double time_s,
                                         double step_s) {
  const glm::dvec3 place(ears.world_from_camera[3]);
  find_paths(emitters, place);
  std::vector<HeardSound> result;
  for (const Emitter& emitter : emitters) {
    const auto found = found_paths_.find(key_of(emitter.position));
    const std::vector<HeardSound> of_emitter =
        heard_of(emitter, ears, time_s,
                 found == found_paths_.end() ? std::vector<propagation::SoundPath>() : found->second);
    result.insert(result.end(), of_emitter.begin(), of_emitter.end());
  }
  add_late_field(emitters, place, time_s, step_s, result);
  sources_ = emitters.size();
  return result;
}

}  // namespace parvis::sound
