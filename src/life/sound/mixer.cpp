#include "life/sound/mixer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace parvis::sound {
namespace {

constexpr float head_radius_m = 0.0875f, speed_of_sound_m_s = 340.0f;
constexpr std::size_t max_delay = 64;   // samples: more than the head's 0.66 ms
constexpr double visible_weight = 2.0;  // of energy where clusters are chosen
constexpr float loudspeaker_rad = std::numbers::pi_v<float> / 6.0f;

double total(const Octaves& energies) {
  double sum = 0.0;
  for (std::size_t band = 0; band < octaves; ++band)
    sum += energies[band] * propagation::energy(propagation::a_weights_db[band]);
  return sum;
}

float angle_between(glm::vec3 a, glm::vec3 b) { return std::acos(std::clamp(glm::dot(a, b), -1.0f, 1.0f)); }

Octaves amplitudes_of(const Octaves& energies) {
  Octaves result;
  for (std::size_t band = 0; band < octaves; ++band) result[band] = std::sqrt(energies[band]);
  return result;
}

/// The effect of a spherical head on one ear for a direction: 0 left, 1 right.
struct Ear {
  float delay, high;  ///< samples; gain of high frequencies
};

Ear ear_of(glm::vec3 direction, int ear) {
  const float toward = ear == 0 ? -direction.x : direction.x;  // cosine of the angle to the ear's axis
  const float angle = std::asin(std::clamp(toward, -1.0f, 1.0f));
  // Woodworth: the near ear is reached earlier along the line, the far one later along the sphere.
  const float early_m = head_radius_m * (angle > 0.0f ? std::sin(angle) : angle);
  const float delay = 0.5f * float(max_delay) - early_m / speed_of_sound_m_s * float(sample_rate);
  return {delay, 1.05f + 0.95f * std::cos((std::acos(std::clamp(toward, -1.0f, 1.0f))) * 180.0f / 150.0f)};
}

}  // namespace

Mixer::Mixer(Output output, const MixerLimits& limits)
    : output_(output), limits_(limits), clusters_(limits.clusters) {
  for (std::size_t i = 0; i < clusters_.size(); ++i) {
    clusters_[i].past.assign(max_delay, 0.0f);
    clusters_[i].place = double(i) * double(BandNoise::length) / double(clusters_.size());
  }
}

void Mixer::choose_clusters(std::span<const HeardSound> sounds) {
  std::vector<double> loudness(sounds.size());
  for (std::size_t i = 0; i < sounds.size(); ++i)
    loudness[i] = total(sounds[i].energy) * (sounds[i].is_visible ? visible_weight : 1.0);
  order_.resize(sounds.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::ranges::sort(order_, [&](std::size_t a, std::size_t b) { return loudness[a] > loudness[b]; });

  // Farthest points first, weighted by loudness (Hochbaum and Shmoys 1985): a cluster keeps its place as long
  // as it is near what it stands for.
  const std::size_t candidates = std::min<std::size_t>(order_.size(), 512);
  std::vector<glm::vec3> centres;
  std::vector<float> apart(candidates, std::numeric_limits<float>::max());
  while (centres.size() < clusters_.size() && centres.size() < candidates) {
    std::size_t best = 0;
    double largest = 0.0;
    for (std::size_t k = 0; k < candidates; ++k) {
      const double error =
          centres.empty() ? loudness[order_[k]] : loudness[order_[k]] * double(apart[k]) * double(apart[k]);
      if (error > largest) largest = error, best = k;
    }
    constexpr double negligible = 1e-6;  // of the loudest: another direction for it is not heard
    if (!centres.empty() && largest <= negligible * loudness[order_[0]]) break;
    centres.push_back(sounds[order_[best]].direction);
    for (std::size_t k = 0; k < candidates; ++k)
      apart[k] = std::min(apart[k], angle_between(sounds[order_[k]].direction, centres.back()));
  }
  counts_.clusters = centres.size();

  // Each centre takes over the nearest cluster of the moment before, so that clusters keep their streams.
  std::vector<std::size_t> cluster_of_centre(centres.size());
  std::vector<bool> is_taken(clusters_.size(), false);
  for (std::size_t c = 0; c < centres.size(); ++c) {
    std::size_t nearest = clusters_.size();
    float least = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < clusters_.size(); ++i) {
      if (is_taken[i]) continue;
      const float away =
          clusters_[i].is_used ? angle_between(clusters_[i].next_direction, centres[c]) : 10.0f;
      if (away < least) least = away, nearest = i;
    }
    is_taken[nearest] = true, cluster_of_centre[c] = nearest;
  }
  cluster_of_.assign(sounds.size(), 0);
  std::vector<glm::vec3> sums(clusters_.size(), glm::vec3(0.0f));
  for (std::size_t i = 0; i < sounds.size(); ++i) {
    std::size_t nearest = 0;
    float closest = -2.0f;
    for (std::size_t c = 0; c < centres.size(); ++c)
      if (const float cosine = glm::dot(sounds[i].direction, centres[c]); cosine > closest)
        closest = cosine, nearest = c;
    if (centres.empty()) break;
    cluster_of_[i] = cluster_of_centre[nearest];
    sums[cluster_of_[i]] += float(std::sqrt(loudness[i])) * sounds[i].direction;
  }
  for (std::size_t i = 0; i < clusters_.size(); ++i) {
    Cluster& cluster = clusters_[i];
    const bool was_used = cluster.is_used;
    cluster.direction = cluster.next_direction, cluster.amplitude = cluster.next;
    cluster.next.fill(0.0);
    if (!is_taken[i] || glm::length(sums[i]) <= 0.0f) {
      cluster.is_used = std::ranges::any_of(cluster.amplitude, [](double a) { return a > 0.0; });
      continue;
    }
    cluster.next_direction = glm::normalize(sums[i]);
    if (!was_used) cluster.direction = cluster.next_direction;
    cluster.is_used = true;
  }
}

void Mixer::play_events(std::span<const HeardSound> sounds) {
  for (auto& [id, playing] : playing_) playing.is_heard = false;
  std::size_t events = 0;
  for (const std::size_t i : order_) {
    const HeardSound& sound = sounds[i];
    if (!has_events(sound.kind) || events == limits_.events || total(sound.energy) <= 0.0) continue;
    ++events;
    auto found = std::ranges::find(playing_, sound.id, &std::pair<std::uint64_t, Playing>::first);
    const std::size_t length = signals_[cluster_of_[i]].size();
    const double moment_s = double(length) / sample_rate;
    if (found == playing_.end()) {
      playing_.push_back({sound.id, {sound.kind, sound.emitted_s - moment_s, {}, cluster_of_[i], true}});
      found = playing_.end() - 1;
    }
    Playing& playing = found->second;
    playing.is_heard = true;
    const Octaves now = amplitudes_of(sound.energy);
    const double begin_s = std::abs(sound.emitted_s - moment_s - playing.emitted_s) < 0.5 * moment_s
                               ? playing.emitted_s
                               : sound.emitted_s - moment_s;  // it has jumped: no glide
    if (playing.cluster == cluster_of_[i]) {
      add_sound(sound.kind, sound.id, begin_s, sound.emitted_s, playing.amplitude, now,
                signals_[playing.cluster]);
    } else {  // faded over from its former cluster to the new one
      add_sound(sound.kind, sound.id, begin_s, sound.emitted_s, playing.amplitude, {},
                signals_[playing.cluster]);
      add_sound(sound.kind, sound.id, begin_s, sound.emitted_s, {}, now, signals_[cluster_of_[i]]);
    }
    playing.emitted_s = sound.emitted_s, playing.amplitude = now, playing.cluster = cluster_of_[i];
  }
  for (auto& [id, playing] : playing_)
    if (!playing.is_heard) {  // faded out
      const double end_s = playing.emitted_s + double(signals_[0].size()) / sample_rate;
      add_sound(playing.kind, id, playing.emitted_s, end_s, playing.amplitude, {}, signals_[playing.cluster]);
    }
  std::erase_if(playing_, [](const auto& it) { return !it.second.is_heard; });
  counts_.events = events;
}

void Mixer::spatialise(Cluster& cluster, std::span<const float> signal, std::span<float> left,
                       std::span<float> right) const {
  const std::size_t count = signal.size();
  std::span<float> channels[]{left, right};
  if (output_ != Output::headphones) {
    for (int channel = 0; channel < 2; ++channel) {
      const auto gain_of = [&](glm::vec3 direction) {
        if (output_ == Output::microphone) return 1.0f;
        const float azimuth = std::asin(std::clamp(direction.x, -1.0f, 1.0f));  // behind as before
        const float pan = 0.5f + 0.5f * std::clamp(azimuth / loudspeaker_rad, -1.0f, 1.0f);
        const float quarter = 0.5f * std::numbers::pi_v<float>;
        return channel == 0 ? std::cos(quarter * pan) : std::sin(quarter * pan);
      };
      const float from = gain_of(cluster.direction), to = gain_of(cluster.next_direction);
      for (std::size_t i = 0; i < count; ++i)
        channels[channel][i] += std::lerp(from, to, float(i) / float(count)) * signal[i];
    }
    return;
  }
  std::vector<float> line(cluster.past);
  line.insert(line.end(), signal.begin(), signal.end());
  // Shadow: (high s + corner)/(s + corner) with the corner at c/a, by the bilinear transform.
  const float corner = 2.0f * speed_of_sound_m_s / head_radius_m, step = 2.0f * float(sample_rate);
  for (int ear = 0; ear < 2; ++ear) {
    const Ear from = ear_of(cluster.direction, ear), to = ear_of(cluster.next_direction, ear);
    float last_in = cluster.shadow_in[std::size_t(ear)], last_out = cluster.shadow_out[std::size_t(ear)];
    for (std::size_t i = 0; i < count; ++i) {
      const float part = float(i) / float(count),
                  place = float(i + max_delay) - std::lerp(from.delay, to.delay, part);
      const auto whole = std::size_t(place);
      const float in =
          std::lerp(line[whole], line[std::min(whole + 1, line.size() - 1)], place - float(whole));
      const float high = std::lerp(from.high, to.high, part);
      const float out =
          ((corner + high * step) * in + (corner - high * step) * last_in - (corner - step) * last_out) /
          (corner + step);
      channels[ear][i] += out;
      last_in = in, last_out = out;
    }
    cluster.shadow_in[std::size_t(ear)] = last_in, cluster.shadow_out[std::size_t(ear)] = last_out;
  }
  cluster.past.assign(line.end() - std::ptrdiff_t(max_delay), line.end());
}

void Mixer::mix(std::span<const HeardSound> all, std::span<float> left, std::span<float> right) {
  counts_ = {};
  counts_.sounds = all.size();
  if (left.empty()) return;
  // Masking: of the sounds in the order of loudness those count that any octave needs.
  std::vector<std::size_t> by_loudness(all.size());
  std::iota(by_loudness.begin(), by_loudness.end(), std::size_t{0});
  std::vector<double> loudness(all.size());
  Octaves rest{};
  for (std::size_t i = 0; i < all.size(); ++i) {
    loudness[i] = total(all[i].energy);
    for (std::size_t band = 0; band < octaves; ++band) rest[band] += all[i].energy[band];
  }
  std::ranges::sort(by_loudness, [&](std::size_t a, std::size_t b) { return loudness[a] > loudness[b]; });
  const double audible = propagation::energy(-limits_.masked_db);
  Octaves sum = rest;
  std::vector<HeardSound> sounds;
  for (const std::size_t i : by_loudness) {
    bool is_heard = false;
    for (std::size_t band = 0; band < octaves; ++band) is_heard |= rest[band] > audible * sum[band];
    if (!is_heard || !std::isfinite(loudness[i])) break;
    for (std::size_t band = 0; band < octaves; ++band) rest[band] -= all[i].energy[band];
    sounds.push_back(all[i]);
  }
  counts_.masked = all.size() - sounds.size();

  choose_clusters(sounds);
  signals_.resize(clusters_.size());
  for (std::vector<float>& signal : signals_) signal.assign(left.size(), 0.0f);
  play_events(sounds);

  double weight = 0.0;
  for (std::size_t i = 0; i < sounds.size(); ++i) {
    const double energy = total(sounds[i].energy);
    weight += energy;
    counts_.direction_error_rad +=
        energy * double(angle_between(sounds[i].direction, clusters_[cluster_of_[i]].next_direction));
  }
  if (weight > 0.0) counts_.direction_error_rad /= weight;

  // Steady noise, and events beyond the budget: energies add up.
  std::vector<Octaves> energies(clusters_.size(), Octaves{});
  std::size_t events = 0;
  for (const std::size_t i : order_) {
    if (has_events(sounds[i].kind) && total(sounds[i].energy) > 0.0 && events < limits_.events) {
      ++events;
      continue;
    }
    const double fraction = has_events(sounds[i].kind) ? 0.1 : 1.0;  // events last a tenth of the time
    for (std::size_t band = 0; band < octaves; ++band)
      energies[cluster_of_[i]][band] += fraction * sounds[i].energy[band];
  }
  for (std::size_t c = 0; c < clusters_.size(); ++c) {
    Cluster& cluster = clusters_[c];
    if (!cluster.is_used) continue;
    cluster.next = amplitudes_of(energies[c]);
    cluster.place =
        BandNoise::instance().add(signals_[c], cluster.place, 1.0, cluster.amplitude, cluster.next);
    spatialise(cluster, signals_[c], left, right);
  }
}

}  // namespace parvis::sound
