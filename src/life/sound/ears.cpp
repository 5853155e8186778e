#include "life/sound/ears.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace parvis::sound {
namespace {

constexpr float head_radius_m = 0.0875f, head_sound_speed_m_s = 340.0f;
constexpr std::size_t max_delay = 64;  // samples: more than the head's 0.66 ms
constexpr float loudspeaker_rad = std::numbers::pi_v<float> / 6.0f,
                quarter = 0.5f * std::numbers::pi_v<float>;

/// The effect of a spherical head on one ear for a direction: 0 left, 1 right.
struct Ear {
  float delay, high;  ///< samples; gain of high frequencies
};

Ear ear_of(glm::vec3 direction, int ear) {
  const float toward = ear == 0 ? -direction.x : direction.x;  // cosine of the angle to the ear's axis
  const float angle = std::asin(std::clamp(toward, -1.0f, 1.0f));
  // Woodworth: the near ear is reached earlier along the line, the far one later along the sphere.
  const float early_m = head_radius_m * (angle > 0.0f ? std::sin(angle) : angle);
  const float delay = 0.5f * float(max_delay) - early_m / head_sound_speed_m_s * float(sample_rate);
  return {delay, 1.05f + 0.95f * std::cos((std::acos(std::clamp(toward, -1.0f, 1.0f))) * 180.0f / 150.0f)};
}

constexpr Channel left_channel{"front left", 0x1, -30.0f}, right_channel{"front right", 0x2, 30.0f},
    centre_channel{"front centre", 0x4, 0.0f}, low_channel{"low frequencies", 0x8, std::nullopt};

glm::vec2 toward(float azimuth_deg) {
  const float azimuth = azimuth_deg * std::numbers::pi_v<float> / 180.0f;
  return {std::sin(azimuth), std::cos(azimuth)};
}

using Gains = std::array<float, 8>;

/// Gains of the two loudspeakers between which a direction lies, of unit power (Pulkki 1997, in plan). A
/// sound from above comes from all of them.
Gains gains_around(std::span<const Channel> channels, glm::vec3 direction) {
  Gains gains{};
  const glm::vec2 plan(direction);
  const float flat = std::min(glm::dot(plan, plan), 1.0f);
  std::size_t speakers = 0;
  for (std::size_t a = 0; a < channels.size(); ++a) {
    if (!channels[a].azimuth_deg) continue;
    ++speakers;
    // The next loudspeaker clockwise.
    std::size_t b = a;
    float least = 361.0f;
    for (std::size_t k = 0; k < channels.size(); ++k) {
      if (k == a || !channels[k].azimuth_deg) continue;
      const float ahead = std::fmod(*channels[k].azimuth_deg - *channels[a].azimuth_deg + 720.0f, 360.0f);
      if (ahead < least) least = ahead, b = k;
    }
    const glm::vec2 u = toward(*channels[a].azimuth_deg), v = toward(*channels[b].azimuth_deg);
    const float area = u.x * v.y - u.y * v.x;
    const float of_a = (plan.x * v.y - plan.y * v.x) / area, of_b = (u.x * plan.y - u.y * plan.x) / area;
    if (of_a < 0.0f || of_b < 0.0f || flat < 1e-6f) continue;
    const float length = std::hypot(of_a, of_b);
    gains = {};
    gains[a] = of_a / length, gains[b] = of_b / length;
  }
  for (std::size_t k = 0; k < channels.size(); ++k)
    if (channels[k].azimuth_deg)
      gains[k] = std::sqrt(flat * gains[k] * gains[k] + (1.0f - flat) / float(speakers));
  return gains;
}

Gains gains_of(Output output, glm::vec3 direction) {
  if (output == Output::microphone) return {1.0f, 1.0f};
  if (output != Output::stereo) return gains_around(channels_of(output), direction);
  const float azimuth = std::asin(std::clamp(direction.x, -1.0f, 1.0f));  // behind as before
  const float pan = 0.5f + 0.5f * std::clamp(azimuth / loudspeaker_rad, -1.0f, 1.0f);
  return {std::cos(quarter * pan), std::sin(quarter * pan)};
}

}  // namespace

std::span<const Channel> channels_of(Output output) {
  static constexpr Channel two[]{left_channel, right_channel};
  static constexpr Channel four[]{{"front left", 0x1, -45.0f},
                                  {"front right", 0x2, 45.0f},
                                  {"back left", 0x10, -135.0f},
                                  {"back right", 0x20, 135.0f}};
  static constexpr Channel five[]{left_channel,
                                  right_channel,
                                  centre_channel,
                                  low_channel,
                                  {"side left", 0x200, -110.0f},
                                  {"side right", 0x400, 110.0f}};
  static constexpr Channel seven[]{left_channel,
                                   right_channel,
                                   centre_channel,
                                   low_channel,
                                   {"back left", 0x10, -150.0f},
                                   {"back right", 0x20, 150.0f},
                                   {"side left", 0x200, -90.0f},
                                   {"side right", 0x400, 90.0f}};
  switch (output) {
    case Output::surround_4:
      return four;
    case Output::surround_5:
      return five;
    case Output::surround_7:
      return seven;
    default:
      return two;
  }
}

Spatialiser::Spatialiser(Output output, std::size_t streams) : output_(output), heads_(streams) {
  for (Head& head : heads_) head.past.assign(max_delay, 0.0f);
}

void Spatialiser::add_to_head(Head& head, const Stream& stream, Buffers buffers) const {
  const std::size_t count = stream.signal.size();
  std::vector<float> line(head.past);
  line.insert(line.end(), stream.signal.begin(), stream.signal.end());
  // Shadow: (high s + corner)/(s + corner) with the corner at c/a, by the bilinear transform.
  const float corner = 2.0f * head_sound_speed_m_s / head_radius_m, step = 2.0f * float(sample_rate);
  for (std::size_t ear = 0; ear < 2; ++ear) {
    const Ear from = ear_of(stream.from, int(ear)), to = ear_of(stream.to, int(ear));
    float last_in = head.shadow_in[ear], last_out = head.shadow_out[ear];
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
      buffers[ear][i] += out;
      last_in = in, last_out = out;
    }
    head.shadow_in[ear] = last_in, head.shadow_out[ear] = last_out;
  }
  head.past.assign(line.end() - std::ptrdiff_t(max_delay), line.end());
}

void Spatialiser::add(std::span<const Stream> streams, Buffers buffers) {
  assert(streams.size() <= heads_.size() && buffers.size() == channels_of(output_).size());
  for (std::size_t s = 0; s < streams.size(); ++s) {
    const Stream& stream = streams[s];
    if (!stream.is_used) continue;
    if (output_ == Output::headphones) {
      add_to_head(heads_[s], stream, buffers);
      continue;
    }
    const Gains from = gains_of(output_, stream.from), to = gains_of(output_, stream.to);
    const float count = float(stream.signal.size());
    for (std::size_t channel = 0; channel < buffers.size(); ++channel) {
      if (from[channel] == 0.0f && to[channel] == 0.0f) continue;
      for (std::size_t i = 0; i < stream.signal.size(); ++i)
        buffers[channel][i] += std::lerp(from[channel], to[channel], float(i) / count) * stream.signal[i];
    }
  }
}

}  // namespace parvis::sound
