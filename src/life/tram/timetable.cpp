#include "life/tram/timetable.h"

#include <algorithm>
#include <cmath>

namespace parvis::tram {
namespace {

/// The radius of the line at a place, from its directions 3 m before and behind; metres.
float radius_at(const scene::MeasuredPath& line, float along) {
  constexpr float reach_m = 3.0f;
  const glm::vec3 a = line.direction_at(along - reach_m), b = line.direction_at(along + reach_m);
  const float turn = std::abs(std::atan2(scene::cross_in_plan(a, b), a.x * b.x + a.y * b.y));
  return 2.0f * reach_m / std::max(turn, 1e-5f);
}

}  // namespace

Timetable::Timetable(const scene::MeasuredPath& line, float first_m, float last_m, std::vector<Stop> stops,
                     float max_speed_m_s, float tram_length_m)
    : first_m_(first_m), stops_(std::move(stops)) {
  const std::size_t places = std::size_t(std::ceil((last_m - first_m) / step_m)) + 1;
  limit_.resize(places), stop_at_.assign(places, -1);
  const int tail_places = int(std::ceil(tram_length_m / step_m));
  std::vector<float> alone(places + std::size_t(tail_places));  // from a tram's length before the first place
  for (std::size_t i = 0; i < alone.size(); ++i) {
    const float along = first_m + step_m * (float(i) - float(tail_places));
    alone[i] = std::min(max_speed_m_s, std::sqrt(lateral_m_s2 * radius_at(line, along)));
  }
  for (std::size_t i = 0; i < places; ++i)
    limit_[i] = *std::min_element(alone.begin() + long(i), alone.begin() + long(i) + tail_places + 1);
  speed_ = limit_;
  for (std::size_t s = 0; s < stops_.size(); ++s) {
    const auto place = std::size_t(std::lround((stops_[s].front_m - first_m) / step_m));
    stop_at_[std::min(place, places - 1)] = int(s);
    speed_[std::min(place, places - 1)] = 0.0f;
  }
  for (std::size_t i = 1; i < places; ++i)
    speed_[i] =
        std::min(speed_[i], std::sqrt(speed_[i - 1] * speed_[i - 1] + 2.0f * acceleration_m_s2 * step_m));
  for (std::size_t i = places - 1; i-- > 0;)
    speed_[i] = std::min(speed_[i], std::sqrt(speed_[i + 1] * speed_[i + 1] + 2.0f * braking_m_s2 * step_m));
  arrives_s_.resize(places), leaves_s_.resize(places);
  double time_s = 0.0;
  for (std::size_t i = 0; i < places; ++i) {
    if (i > 0) time_s += double(2.0f * step_m / (speed_[i - 1] + speed_[i]));
    arrives_s_[i] = time_s;
    if (stop_at_[i] >= 0) time_s += double(stops_[std::size_t(stop_at_[i])].dwell_s);
    leaves_s_[i] = time_s;
  }
}

Moment Timetable::at(double time_s) const {
  const auto later = std::ranges::upper_bound(leaves_s_, time_s);
  const auto next = std::size_t(later - leaves_s_.begin());
  const auto place_m = [this](std::size_t place) {
    return double(first_m_) + double(step_m) * double(place);
  };
  if (next == leaves_s_.size()) return {place_m(next - 1), speed_.back(), -1, 0.0f};
  if (time_s >= arrives_s_[next]) {
    const double since_s = time_s - arrives_s_[next], left_s = leaves_s_[next] - time_s;
    const float doors = std::clamp(float(std::min(since_s, left_s)) / doors_move_s, 0.0f, 1.0f);
    return {place_m(next), 0.0f, stop_at_[next], doors * doors * (3.0f - 2.0f * doors), left_s};
  }
  if (next == 0) return {place_m(0), speed_.front(), -1, 0.0f};
  // Constant acceleration between two places.
  const double t = time_s - leaves_s_[next - 1],
               a = double(speed_[next] - speed_[next - 1]) / (arrives_s_[next] - leaves_s_[next - 1]);
  const double v = double(speed_[next - 1]);
  return {place_m(next - 1) + v * t + 0.5 * a * t * t, float(v + a * t), -1, 0.0f};
}

double Timetable::reaches_s(float front_m) const {
  const long place = long(std::ceil((front_m - first_m_) / step_m));
  return arrives_s_[std::size_t(std::clamp(place, 0l, long(arrives_s_.size()) - 1))];
}

float Timetable::speed_limit_m_s(float front_m) const {
  const long place = std::lround((front_m - first_m_) / step_m);
  return limit_[std::size_t(std::clamp(place, 0l, long(limit_.size()) - 1))];
}

}  // namespace parvis::tram
