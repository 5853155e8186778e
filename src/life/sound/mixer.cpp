#include "life/sound/mixer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace parvis::sound {
namespace {

constexpr double visible_weight = 2.0;  // of energy where clusters are chosen

double total(const Octaves& energies) {
  static const Octaves weights = [] {
    Octaves result;
    for (std::size_t band = 0; band < octaves; ++band)
      result[band] = propagation::energy(propagation::a_weights_db[band]);
    return result;
  }();
  double sum = 0.0;
  for (std::size_t band = 0; band < octaves; ++band) sum += energies[band] * weights[band];
  return sum;
}

float angle_between(glm::vec3 a, glm::vec3 b) { return std::acos(std::clamp(glm::dot(a, b), -1.0f, 1.0f)); }

Octaves amplitudes_of(const Octaves& energies) {
  Octaves result;
  for (std::size_t band = 0; band < octaves; ++band) result[band] = std::sqrt(energies[band]);
  return result;
}

}  // namespace

void keep_loudest(std::vector<HeardSound>& sounds, std::size_t count) {
  if (sounds.size() <= count) return;
  std::vector<double> loudness;
  for (const HeardSound& sound : sounds) loudness.push_back(total(sound.energy));
  std::ranges::nth_element(loudness, loudness.begin() + std::ptrdiff_t(count), std::ranges::greater{});
  const double too_quiet = loudness[count];
  // Of equally loud ones the first stay.
  std::size_t louder =
      std::size_t(std::ranges::count_if(loudness, [&](double it) { return it > too_quiet; }));
  std::erase_if(sounds, [&](const HeardSound& sound) {
    const double here = total(sound.energy);
    return here < too_quiet || (here == too_quiet && louder++ >= count);
  });
}

Mixer::Mixer(Output output, const MixerLimits& limits)
    : limits_(limits),
      // A microphone has no directions: in one cluster the energies of steady noise add up exactly.
      clusters_(output == Output::microphone ? 1 : limits.clusters),
      spatialiser_(output, clusters_.size()) {
  for (std::size_t i = 0; i < clusters_.size(); ++i)
    clusters_[i].place = double(i) * double(BandNoise::length) / double(clusters_.size());
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
      const bool sounded = std::ranges::any_of(cluster.amplitude, [](double a) { return a > 0.0; });
      cluster.is_used = sounded || cluster.is_ending;
      cluster.is_ending = sounded;
      continue;
    }
    cluster.next_direction = glm::normalize(sums[i]);
    if (!was_used) cluster.direction = cluster.next_direction;
    cluster.is_used = cluster.is_ending = true;
  }
}

void Mixer::play_events(std::span<const HeardSound> sounds) {
  for (auto& [id, playing] : playing_) playing.is_heard = false;
  std::size_t events = 0;
  const auto add = [&](const Playing& it, double begin_s, double end_s, const Octaves& from,
                       const Octaves& to, std::size_t cluster) {
    clusters_[cluster].is_used = clusters_[cluster].is_ending = true;
    if (it.recording)
      it.recording->add(begin_s, end_s, from, to, signals_[cluster]);
    else
      add_sound(it.kind, it.seed, begin_s, end_s, from, to, signals_[cluster]);
  };
  for (const std::size_t i : order_) {
    const HeardSound& sound = sounds[i];
    if (!has_events(sound.kind) || events == limits_.events || total(sound.energy) <= 0.0) continue;
    ++events;
    auto found = std::ranges::find(playing_, sound.id, &std::pair<std::uint64_t, Playing>::first);
    const std::size_t length = signals_[cluster_of_[i]].size();
    const double moment_s = double(length) / sample_rate;
    if (found == playing_.end()) {
      playing_.push_back(
          {sound.id,
           {sound.kind, sound.seed, sound.recording, sound.emitted_s - moment_s, {}, cluster_of_[i], true}});
      found = playing_.end() - 1;
    }
    Playing& playing = found->second;
    playing.is_heard = true;
    const Octaves now = amplitudes_of(sound.energy);
    const double begin_s = std::abs(sound.emitted_s - moment_s - playing.emitted_s) < 0.5 * moment_s
                               ? playing.emitted_s
                               : sound.emitted_s - moment_s;  // it has jumped: no glide
    if (playing.cluster == cluster_of_[i]) {
      add(playing, begin_s, sound.emitted_s, playing.amplitude, now, playing.cluster);
    } else {  // faded over from its former cluster to the new one
      add(playing, begin_s, sound.emitted_s, playing.amplitude, {}, playing.cluster);
      add(playing, begin_s, sound.emitted_s, {}, now, cluster_of_[i]);
    }
    playing.emitted_s = sound.emitted_s, playing.amplitude = now, playing.cluster = cluster_of_[i];
  }
  for (auto& [id, playing] : playing_)
    if (!playing.is_heard) {  // faded out
      const double end_s = playing.emitted_s + double(signals_[0].size()) / sample_rate;
      add(playing, playing.emitted_s, end_s, playing.amplitude, {}, playing.cluster);
    }
  std::erase_if(playing_, [](const auto& it) { return !it.second.is_heard; });
  counts_.events = events;
}

void Mixer::mix(std::span<const HeardSound> sounds, Buffers buffers) {
  if (!buffers[0].empty()) spatialiser_.add(premix(sounds, buffers[0].size()), buffers);
}

void Mixer::mix(std::span<const HeardSound> sounds, std::span<float> left, std::span<float> right) {
  const std::array buffers{left, right};
  mix(sounds, buffers);
}

std::span<const Stream> Mixer::premix(std::span<const HeardSound> all, std::size_t samples) {
  counts_ = {};
  counts_.sounds = all.size();
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
  for (std::vector<float>& signal : signals_) signal.assign(samples, 0.0f);
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
    if (sounds[i].recording) continue;                               // beyond the budget: it is left out
    const double fraction = has_events(sounds[i].kind) ? 0.1 : 1.0;  // events last a tenth of the time
    for (std::size_t band = 0; band < octaves; ++band)
      energies[cluster_of_[i]][band] += fraction * sounds[i].energy[band];
  }
  streams_.assign(clusters_.size(), Stream{});
  for (std::size_t c = 0; c < clusters_.size(); ++c) {
    Cluster& cluster = clusters_[c];
    if (!cluster.is_used) continue;
    cluster.next = amplitudes_of(energies[c]);
    cluster.place =
        BandNoise::instance().add(signals_[c], cluster.place, 1.0, cluster.amplitude, cluster.next);
    streams_[c] = {cluster.direction, cluster.next_direction, signals_[c], true};
  }
  return streams_;
}

}  // namespace parvis::sound
