#include "life/sound/playback.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

namespace parvis::sound {
namespace {

constexpr double device_moment_s = double(device_moment) / sample_rate;
constexpr double longest_glide_s = 0.5;  // between two calls of update

HeardSound silent(HeardSound sound) {
  sound.energy.fill(0.0);
  return sound;
}

/// A sound between two moments.
HeardSound glided(const HeardSound& from, const HeardSound& to, double part) {
  HeardSound result = to;
  const glm::vec3 direction = glm::mix(from.direction, to.direction, float(part));
  if (glm::length(direction) > 1e-3f) result.direction = glm::normalize(direction);
  result.emitted_s = std::lerp(from.emitted_s, to.emitted_s, part);
  for (std::size_t band = 0; band < octaves; ++band)
    result.energy[band] = std::lerp(from.energy[band], to.energy[band], part);
  return result;
}

/// Adds beds whose gains go evenly from those of the last moment to these: what begins or ends does not
/// click.
void add_beds(std::span<const Bed> last, std::span<const Bed> beds, double now_s, Buffers channels) {
  struct Glide {
    float from = 0.0f, to = 0.0f;
  };
  std::map<std::shared_ptr<const Recording>, Glide> gains;
  for (const Bed& bed : last) gains[bed.recording].from += bed.gain;
  for (const Bed& bed : beds) gains[bed.recording].to += bed.gain;
  for (const auto& [recording, gain] : gains) {
    std::array<std::vector<float>, 2> samples{std::vector<float>(device_moment, 0.0f),
                                              std::vector<float>(device_moment, 0.0f)};
    Bed{recording, 1.0f}.add(now_s, std::array{std::span(samples[0]), std::span(samples[1])});
    for (std::size_t channel = 0; channel < samples.size(); ++channel)
      for (std::size_t i = 0; i < device_moment; ++i)
        channels[channel][i] +=
            samples[channel][i] * std::lerp(gain.from, gain.to, float(i) / float(device_moment));
  }
}

}  // namespace

Playback::Playback(OpenDevice open, double louder_db, double retry_s)
    : open_(std::move(open)),
      gain_(propagation::energy(louder_db)),
      retry_s_(retry_s),
      thread_([this] { run(); }) {}

Playback::~Playback() {
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Playback::update(std::vector<HeardSound> heard, std::vector<Bed> beds, double time_s) {
  const std::scoped_lock lock(mutex_);
  const double played_s = double(moments_) * device_moment_s;
  // What is heard at this very moment is where the glide begins, even where the last one has not ended.
  Snapshot reached;
  for (HeardSound& sound : sounds_at(played_s)) reached.sounds.emplace(sound.id, sound);
  reached.begin_s = std::max(now_.begin_s, played_s - longest_glide_s);
  before_ = std::move(reached);
  now_ = {};
  now_.begin_s = played_s;
  for (HeardSound& sound : heard) {
    sound.emitted_s = time_s - sound.emitted_s;
    now_.sounds.emplace(sound.id, std::move(sound));
  }
  beds_ = std::move(beds);
}

std::vector<HeardSound> Playback::sounds_at(double now_s) const {
  const double glide_s = std::max(now_.begin_s - before_.begin_s, device_moment_s),
               part = std::clamp((now_s - now_.begin_s) / glide_s, 0.0, 1.0);
  std::vector<HeardSound> result;
  for (const auto& [id, sound] : now_.sounds) {
    const auto earlier = before_.sounds.find(id);
    result.push_back(glided(earlier == before_.sounds.end() ? silent(sound) : earlier->second, sound, part));
  }
  if (part < 1.0)
    for (const auto& [id, sound] : before_.sounds)
      if (!now_.sounds.contains(id)) result.push_back(glided(sound, silent(sound), part));
  return result;
}

void Playback::mute(bool is_muted) {
  const std::scoped_lock lock(mutex_);
  is_muted_ = is_muted;
}

bool Playback::is_muted() const {
  const std::scoped_lock lock(mutex_);
  return is_muted_;
}

std::size_t Playback::moments() const {
  const std::scoped_lock lock(mutex_);
  return moments_;
}

Playback::Cost Playback::cost() const {
  const std::scoped_lock lock(mutex_);
  return cost_;
}

std::string Playback::take_message() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(message_, {});
}

void Playback::note_cost(double mixing_s, std::size_t voices) {
  const std::scoped_lock lock(mutex_);
  const double fraction = mixing_s / device_moment_s;
  cost_.core_fraction =
      cost_.voices == 0 ? fraction : std::lerp(cost_.core_fraction, fraction, device_moment_s);
  cost_.voices = voices;
}

void Playback::say(std::string text) {
  const std::scoped_lock lock(mutex_);
  message_ = std::move(text);
}

void Playback::run() {
  Mixer mixer(Output::headphones);
  std::unique_ptr<Device> device;
  bool has_failed = false;
  float bed_gain = 0.0f;
  std::vector<Bed> last_beds;
  for (std::unique_lock lock(mutex_); !ends_; lock.lock()) {
    if (!device) {
      lock.unlock();
      Result<std::unique_ptr<Device>> opened = open_(MixerLimits{}.clusters);
      if (opened) {
        device = *std::move(opened);
        if (std::exchange(has_failed, false)) say("Sound is back.");
        continue;
      }
      if (!std::exchange(has_failed, true)) say("No sound: " + to_string(opened.errors()));
      lock.lock();
      changed_.wait_for(lock, std::chrono::duration<double>(retry_s_), [this] { return ends_; });
      lock.unlock();
      continue;
    }
    const double now_s = double(++moments_) * device_moment_s;
    std::vector<HeardSound> sounds = sounds_at(now_s);
    std::vector<Bed> beds = beds_;
    const bool is_muted = is_muted_;
    lock.unlock();
    const auto began = std::chrono::steady_clock::now();

    for (HeardSound& sound : sounds) {
      sound.emitted_s = now_s - sound.emitted_s;
      for (double& energy : sound.energy) energy *= is_muted ? 0.0 : gain_;
    }
    const std::span<const Stream> streams = mixer.premix(sounds, device_moment);
    std::array<std::vector<float>, 2> channels{std::vector<float>(device_moment, 0.0f),
                                               std::vector<float>(device_moment, 0.0f)};
    add_beds(last_beds, beds, now_s, std::array{std::span(channels[0]), std::span(channels[1])});
    last_beds = std::move(beds);
    const float next_gain = is_muted ? 0.0f : float(std::sqrt(gain_));
    for (std::vector<float>& channel : channels)
      for (std::size_t i = 0; i < channel.size(); ++i)
        channel[i] *= std::lerp(bed_gain, next_gain, float(i) / float(device_moment));
    bed_gain = next_gain;
    note_cost(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count(), sounds.size());
    if (const Status status = device->play(streams, {channels[0], channels[1]}); !status) {
      device.reset();
      has_failed = true;
      say("No sound: " + to_string(status.errors()));
    }
  }
}

}  // namespace parvis::sound
